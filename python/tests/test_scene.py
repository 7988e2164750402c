"""Scenes: one judge, whatever they are written in."""

from __future__ import annotations

import copy
import gc
import pickle
import resource
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT
from hypothesis import given
from hypothesis import strategies as st

import tactile_net as tn
from tactile_net._toml import text_of


def test_every_shipped_scene_survives_a_dictionary(shipped: Path) -> None:
    scene = tn.Scene.load(shipped)
    again = tn.Scene.from_dict(scene.to_dict(), file=scene.file)
    assert again.explain() == scene.explain()
    assert str(again) == str(scene)
    assert np.array_equal(again.kernel_matrix(), scene.kernel_matrix())
    assert np.array_equal(again.simulate().readings, scene.simulate().readings)


def test_what_a_scene_says_has_the_shapes_it_promises(shipped: Path) -> None:
    scene = tn.Scene.load(shipped)
    readings = int(np.prod(scene.reading_shape))
    assert scene.taxels.shape == (scene.count,)
    assert len(scene.reading_names) == readings == len(scene.sites.y)
    assert np.array_equal(scene.taxels[scene.sites.taxel], scene.sites.y)
    assert np.allclose(np.diff(scene.y), scene.spacing)
    assert scene.kernel_matrix().shape == (readings, scene.unknowns * len(scene.y))
    assert scene.even == (scene.reading_shape == (len(scene.channels), scene.count))
    html = scene._repr_html_()
    assert html.startswith("<p>") and scene.title.split()[0] in html


def test_messages_advise_pythons_arguments(scene: tn.Scene, tmp_path: Path) -> None:
    """The command says --columns 1-21 and --missing skip in their place."""
    row = ",".join(["1"] * scene.count)
    strange, gap = tmp_path / "strange.csv", tmp_path / "gap.csv"
    strange.write_text(",".join(f"x{chr(97 + i)}" for i in range(scene.count)) + f"\n{row}\n")
    with pytest.raises(tn.InputError, match="columns='1-21'") as refused:
        scene.read(strange)
    assert "--" not in str(refused.value)
    gap.write_text(",".join(scene.reading_names) + f"\n{row}\n,{row[2:]}\n")
    with pytest.raises(tn.InputError, match="missing='skip'"):
        scene.read(gap, missing=False)


def test_dataclasses_say_what_the_file_says(scene: tn.Scene) -> None:
    text = """
        [sensor]
        count = 21
        pitch = 0.5e-3
        depth = 1.5e-3
        reads = ["stress_x"]
        [material]
        youngs_modulus = 0.2e6
        poisson_ratio = 0.45
        [[contact]]
        shape = "cylinder"
        force = 1.0
        half_width = 2e-3
        [noise]
        rms = 1.0
        [reconstruct]
        alpha = 1e-3
        """
    assert tn.Scene.parse(text).explain() == scene.explain()
    assert tn.Scene.parse(text).to_dict() == scene.to_dict()


def test_any_table_goes_by_its_name(scene: tn.Scene) -> None:
    layered = tn.Scene(
        sensor=scene.to_dict()["sensor"],
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45, layer=tn.Layer(thickness=3e-3, base="bonded")),
        contacts=[
            tn.Punch(force=1.0, half_width=1e-3, edge=1e-4, center=-2e-3),
            tn.Wedge(force=0.5, half_width=1e-3, center=2e-3),
            tn.SampledTractions(normal=np.linspace(0.0, 1.0, 21)),
        ],
        crosstalk={"fraction": 0.02},
        quantization={"bits": 12, "range": [-1e4, 1e4]},
    )
    assert "crosstalk" in layered._repr_html_()
    assert "punch" in str(layered) and "wedge" in str(layered)


def test_replace_makes_a_new_scene(scene: tn.Scene) -> None:
    deeper = scene.replace({"sensor.depth": 2e-3, "contact.0.force": 2.0, "network.realization": "nic", "noise": None})
    assert deeper.sites.depth[0] == 2e-3 and scene.sites.depth[0] == 1.5e-3
    assert deeper.to_dict()["network"] == {"realization": "nic"}
    assert "noise" not in deeper.to_dict()
    with pytest.raises(KeyError, match="number 3 of 1"):
        scene.replace({"contact.3.force": 2.0})
    with pytest.raises(KeyError, match="depth is not a table"):
        scene.replace({"sensor.depth.deeper": 2.0})
    with pytest.raises(KeyError, match="deeper is in no table"):
        scene.replace({"sensor.depth.deeper.still": 2.0})
    with pytest.raises(tn.InputError, match="sensor has .*depth"):
        scene.replace({"sensor.dept": 2e-3})


def test_a_scene_is_its_text(scene: tn.Scene) -> None:
    again = pickle.loads(pickle.dumps(scene))
    assert again == scene and hash(again) == hash(scene) and again is not scene
    assert copy.deepcopy(scene) == scene
    assert eval(repr(scene), {"Scene": tn.Scene}) == scene
    assert scene != scene.replace({"sensor.depth": 2e-3}) and scene != "scene"


def test_what_a_scene_refers_to_is_beside_it(uneven: tn.Scene) -> None:
    assert pickle.loads(pickle.dumps(uneven)).reading_names == uneven.reading_names
    with pytest.raises(tn.InputError, match="strip.csv"):
        tn.Scene.parse(uneven.text)


def test_errors_name_every_place() -> None:
    with pytest.raises(tn.InputError) as caught:
        tn.Scene.parse("[sensor]\ncount = 81\npitch = nan\ndpeth = 1.5\n", file="pad.toml")
    text = str(caught.value)
    assert "pad.toml:3:9: error: sensor.pitch must be a finite number (got nan)" in text
    by_message = {d.message: d for d in caught.value.diagnostics}
    (unknown,) = (d for message, d in by_message.items() if "dpeth" in message)
    assert (unknown.line, unknown.column) == (4, 1) and unknown.file == "pad.toml"
    assert isinstance(caught.value, ValueError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == text and again.diagnostics == caught.value.diagnostics


def test_files_that_are_none() -> None:
    with pytest.raises(FileNotFoundError):
        tn.Scene.load("/nowhere/pad.toml")
    with pytest.raises(IsADirectoryError):
        tn.Scene.load("/")
    with pytest.raises(tn.InputError, match="not UTF-8"):
        tn.Scene.parse(b"title = '\xff'")
    with pytest.raises(tn.InputError, match="not Unicode"):
        tn.Scene.parse("title = '\ud800'")


@given(st.text() | st.binary())
def test_any_text_is_a_scene_or_an_error(text: str | bytes) -> None:
    with pytest.raises(tn.InputError):
        tn.Scene.parse(text)


TOML = st.recursive(
    st.booleans()
    | st.integers(-(2**63), 2**63 - 1)
    | st.floats(allow_nan=False)
    | st.text(st.characters(codec="utf-8")),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(st.characters(codec="utf-8")), inner, max_size=3)
    ),
    max_leaves=12,
)


@given(st.dictionaries(st.text(st.characters(codec="utf-8")), TOML, max_size=4))
def test_dictionaries_are_written_as_toml_means_them(table: dict[str, Any]) -> None:
    import tomllib

    assert tomllib.loads(text_of(table)) == table


def test_numpy_numbers_are_numbers(scene: tn.Scene) -> None:
    table = scene.to_dict()
    table["sensor"] |= {"count": np.int32(21), "pitch": np.float64(0.5e-3), "reads": ("stress_x",)}
    table["material"]["poisson_ratio"] = np.float32(0.5)
    table["contact"] = [{"shape": "tractions", "normal": np.ones(21)}]
    table["reconstruct"]["tangential"] = np.False_
    assert tn.Scene.from_dict(table).count == 21


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (81.0, tn.InputError, "whole number"),
        (float("nan"), tn.InputError, "whole number|finite"),
        ({1, 2}, TypeError, "sensor.count is a set"),
        (object(), TypeError, "sensor.count is a object"),
        (b"81", TypeError, "sensor.count is a bytes"),
        (1j, TypeError, "complex"),
        (None, tn.InputError, "count is missing|count"),
        (2**70, tn.InputError, "count|integer"),
        ([[]], tn.InputError, "count"),
    ],
)
def test_values_that_no_scene_has(scene: tn.Scene, value: Any, error: type[Exception], words: str) -> None:
    table = scene.to_dict()
    table["sensor"]["count"] = value
    with pytest.raises(error, match=words):
        tn.Scene.from_dict(table)


def test_a_table_in_itself_is_refused(scene: tn.Scene) -> None:
    table = scene.to_dict()
    table["sensor"]["sensor"] = table["sensor"]
    with pytest.raises((TypeError, RecursionError)):
        tn.Scene.from_dict(table)
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises((TypeError, RecursionError)):
        tn.Scene.from_dict({"sensor": {"depths": endless}})
    with pytest.raises(TypeError, match="strings"):
        tn.Scene.from_dict({1: 2})  # type: ignore[dict-item]


def test_kernel_and_normal_matrix_are_those_of_the_problem(two: tn.Scene) -> None:
    plain = two.replace({"noise": None, "reconstruct.smoothing_length": 0.0})
    kernel, alpha = plain.kernel_matrix(), 1e-3
    assert np.allclose(plain.normal_matrix(alpha), kernel.T @ kernel + alpha * np.eye(kernel.shape[1]), rtol=1e-12)
    dead = two.replace({"dead_taxels": {"indices": [3]}})
    assert np.array_equal(dead.kernel_matrix(), two.kernel_matrix())
    with pytest.raises(ValueError, match="alpha"):
        plain.normal_matrix(0.0)


def test_the_readings_are_the_kernel_times_the_tractions() -> None:
    scene = tn.Scene.load(PROJECT / "scenes/thesis/cylinder.toml")  # whose forward model is that very sum
    recording = scene.simulate()
    assert recording.truth is not None
    assert np.allclose(scene.kernel_matrix() @ recording.truth[0, 0], recording.readings[0, 0], rtol=1e-12, atol=1e-15)


def test_arrays_that_belong_to_the_scene_cannot_be_written(scene: tn.Scene) -> None:
    with pytest.raises(ValueError, match="read-only"):
        scene.y[0] = 1.0
    y = scene.y
    expected = y.copy()
    del scene
    gc.collect()
    assert np.array_equal(y, expected)


def test_scenes_made_and_dropped_leave_nothing(scene: tn.Scene) -> None:
    def grow(times: int) -> int:
        for _ in range(times):
            copy.deepcopy(scene).simulate()
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = grow(2000)
    assert grow(6000) - before < 4096  # KiB: 0.7 a scene would be a leak

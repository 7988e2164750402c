"""Data sets of studies: the points of a sweep with their seeds, in shards that may be stopped, and what they hold."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT

import tactile_net as tn
from tactile_net import _core


@pytest.fixture
def study(scene: tn.Scene) -> tn.Study:
    timed = scene.replace(
        {
            "time": {"rate": 100.0, "frames": 3},
            "sensor.reads": ["stress_x", "shear_xy"],
            "contact.0.force": None,
            "contact.0.trajectory": [{"t": 0.0, "force": 1.0}, {"t": 0.02, "force": 2.0}],
        }
    )
    return tn.Study(timed, {"contact.0.friction": [0.0, 0.3], "noise.rms": [1.0, 5.0]}, repeats=2)


@pytest.fixture
def skin() -> tn.Study:
    base = tn.Skin(
        sensor=tn.Sensor(rows=4, columns=3, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=2.5e-3, friction=0.4)],
        noise=tn.Noise(rms=10.0),
        units={},
    )
    return tn.Study(base, {"contact.0.force": {"from": 0.1, "to": 1.0}}, draw={"kind": "sobol", "count": 6})


def generated(study: tn.Study, folder: Path, **more: Any) -> tn.datasets.Dataset:
    data = tn.datasets.generate(study, folder, **more)
    assert data is not None
    return data


def test_a_data_set_is_its_points_scenes(study: tn.Study, tmp_path: Path) -> None:
    data = generated(study, tmp_path)
    assert data.readings.shape == (24, 2, 21) and data.readings.dtype == np.float32
    assert data.tractions is not None and data.tractions.shape == (24, 2, 21)
    assert data.axes == ("contact.0.friction", "noise.rms", "repeat")
    assert np.array_equal(data.point, np.repeat(np.arange(8), 3))
    table = tn.sweep(study, tmp_path / "sweep", jobs=1)
    assert table is not None
    assert np.array_equal(data.parameters["seed"], table["seed"])  # those of the sweep
    for point in (0, 5):
        values = {key: float(data.parameters[key][point]) for key in ("contact.0.friction", "noise.rms")}
        scene = study.scene.replace(values | {"noise.seed": int(data.parameters["seed"][point])})
        recording = scene.simulate()
        assert np.array_equal(data.readings[data.point == point], recording.readings.astype(np.float32))
        assert recording.truth is not None
        truth = data.tractions[data.point == point][:, : recording.truth.shape[1]]
        assert np.array_equal(truth, recording.truth.astype(np.float32))
    assert (data["noise.rms"] == np.repeat([1, 1, 5, 5, 1, 1, 5, 5], 3)).all()


@pytest.mark.parametrize("shards", [2, 7])
def test_shards_make_the_same_data_set(study: tn.Study, shards: int, tmp_path: Path) -> None:
    once = generated(study, tmp_path / "one", jobs=3)
    for k in range(shards, 0, -1):
        assert tn.datasets.generate(study, tmp_path / "many", shard=(k, shards), jobs=1) is None
        if k > 1:
            with pytest.raises(tn.InputError, match="points"):
                tn.datasets.load(tmp_path / "many")
    many = tn.datasets.load(tmp_path / "many")
    assert many.sha256 == once.sha256 and np.array_equal(many.readings, once.readings)
    assert np.array_equal(many.point, once.point)
    other = generated(tn.Study(study.scene, study.axes, repeats=2, seed=2), tmp_path / "other")
    assert other.sha256 != once.sha256


class _Stops(Exception):
    pass


@pytest.mark.parametrize("harm", ["nothing", "torn line", "lost numbers"])
def test_what_was_stopped_goes_on(study: tn.Study, harm: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    once = generated(study, tmp_path / "one")

    def stop(words: str) -> None:
        if words.startswith("5 "):
            raise _Stops

    folder = tmp_path / "stopped"
    with pytest.raises(_Stops):
        tn.datasets.generate(study, folder, jobs=1, progress=stop)
    journal, numbers = folder / "shard-1-of-1.part.jsonl", folder / "shard-1-of-1.part.tractions"
    assert len(journal.read_text().splitlines()) == 6 and not (folder / "shard-1-of-1.npz").exists()
    if harm == "torn line":
        journal.write_text(journal.read_text()[:-20])
    if harm == "lost numbers":
        numbers.write_bytes(numbers.read_bytes()[:-100])
    asked = []
    honest = _core.StudyPoints.simulate

    def simulate(self: Any, index: int) -> Any:
        asked.append(index)
        return honest(self, index)

    monkeypatch.setattr(_core.StudyPoints, "simulate", simulate)
    again = generated(study, folder, jobs=1)
    assert asked == list(range(5 if harm == "nothing" else 4, 8))
    assert again.sha256 == once.sha256 and np.array_equal(again.readings, once.readings)
    asked.clear()
    assert generated(study, folder).sha256 == once.sha256 and asked == []
    assert {path.suffix for path in folder.iterdir()} == {".npz", ".toml", ".lock"}


def test_a_shard_is_a_recording(study: tn.Study, skin: tn.Study, tmp_path: Path) -> None:
    for name, one in (("line", study), ("skin", skin)):
        data = generated(one, tmp_path / name)
        recording = tn.load(tmp_path / name / "shard-1-of-1.npz")
        assert recording.scene.text == one.scene.text
        assert np.array_equal(recording.readings, data.readings.astype(np.float64))
        assert recording.truth is not None and np.array_equal(recording.truth, np.asarray(data.tractions, dtype=float))


def test_skins(skin: tn.Study, tmp_path: Path) -> None:
    data = generated(skin, tmp_path)
    assert isinstance(data.scene, tn.Skin)
    assert data.readings.shape == (6, 4, 3, 3) and data.tractions is not None
    assert data.tractions.shape == (6, 3, *data.scene.traction_shape)
    pressed = data.scene.cell_area * data.tractions[:, 0].sum(axis=(1, 2))
    assert np.allclose(pressed, data["contact.0.force"], rtol=1e-5)
    table = tn.sweep(skin, tmp_path / "sweep", jobs=1)
    assert table is not None and len(table) == 6
    assert np.array_equal(table["seed"], data.parameters["seed"]) and (table["verdict"] == "ok").all()
    result = tn.run(skin.scene.replace({"contact.0.force": table["contact.0.force"][2], "noise.seed": int(table["seed"][2])}))
    assert isinstance(result, tn.SkinResult)
    assert table["force"][2] == result.skin.force and table["error"][2] == result.skin.relative_errors[0]
    alone = generated(skin, tmp_path / "alone", keep=["readings"])
    assert alone.tractions is None and np.array_equal(alone.readings, data.readings)


def test_failures_are_rows_without_frames(study: tn.Study, tmp_path: Path) -> None:
    data = generated(tn.Study(study.scene, {"contact.0.half_width": [2e-3, -1.0]}), tmp_path)
    assert data.parameters["failure"][0] == "" and "half_width" in data.parameters["failure"][1]
    assert data.point.tolist() == [0, 0, 0]
    with pytest.raises(tn.InputError, match="has no frame"):
        tn.datasets.generate(tn.Study(study.scene, {"contact.0.half_width": [-1.0]}), tmp_path / "none")


def test_what_is_no_data_set(study: tn.Study, skin: tn.Study, tmp_path: Path) -> None:
    with pytest.raises(tn.InputError, match="one shape"):
        tn.datasets.generate(tn.Study(study.scene, {"sensor.count": [21, 31]}), tmp_path / "shapes")
    with pytest.raises(tn.InputError, match="one shape.*reconstruct.spacing"):
        tn.datasets.generate(tn.Study(skin.scene, {"sensor.depth": [2e-3, 5e-4]}), tmp_path / "depths")
    fixed = skin.scene.replace({"reconstruct": {"spacing": 1e-3, "margin": 2e-3}})
    generated(tn.Study(fixed, {"sensor.depth": [2e-3, 1.5e-3]}), tmp_path / "fixed")
    with pytest.raises(tn.InputError, match="holds no shard"):
        tn.datasets.load(tmp_path)
    generated(study, tmp_path / "mixed", shard=(1, 1))
    with pytest.raises(tn.InputError, match="another study"):
        tn.datasets.generate(tn.Study(study.scene, study.axes, repeats=3), tmp_path / "mixed")
    with pytest.raises(tn.InputError, match="another study"):
        tn.datasets.load(tmp_path / "mixed", tmp_path / "fixed")
    for options in ({"shard": (0, 4)}, {"shard": (5, 4)}, {"keep": ["tractions"]}, {"keep": ["x"]}, {"jobs": 0}):
        with pytest.raises(ValueError, match=next(iter(options))):
            tn.datasets.generate(study, tmp_path / "options", **options)  # type: ignore[arg-type]
    import fcntl

    with open(tmp_path / "mixed/shard-1-of-1.lock", "w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        with pytest.raises(OSError, match="at work on this shard"):
            tn.datasets.generate(study, tmp_path / "mixed")


def test_the_hash_of_a_study_covers_the_files_that_it_names(tmp_path: Path) -> None:
    base = tn.Scene.load(PROJECT / "scenes/coarse/strip.toml")
    name = base.to_dict()["sensor"]["taxels"]
    (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
    text = (PROJECT / "scenes/coarse" / name).read_text()
    (tmp_path / name).write_text(text)
    path = tn.Study(base, {"noise.seed": [1]}).save(tmp_path)
    before = _core.StudyPoints(path, False).hash
    assert _core.StudyPoints(path, False).hash == before
    (tmp_path / name).write_text(text.rstrip("\n") + "\n\n")
    assert _core.StudyPoints(path, False).hash != before

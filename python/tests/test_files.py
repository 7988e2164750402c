"""Recordings on disk: every container gives back what it was given."""

from __future__ import annotations

import dataclasses
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from recordings import DEAD, FLOATS, SMALL, UNITLESS, assert_same, bits

import tactile_net as tn
from tactile_net._layout import layout_of

xarray = pytest.importorskip("xarray")
h5py = pytest.importorskip("h5py")
pandas = pytest.importorskip("pandas")
pytest.importorskip("h5netcdf")
pytest.importorskip("zarr")
pytest.importorskip("pyarrow")

CONTAINERS = (".npz", ".csv", ".nc", ".h5", ".zarr", ".parquet")
SOLVED = (".npz", ".nc", ".zarr")
"""Those that hold a solution too."""


def size(path: Path) -> int:
    """Of a file, or of all in a folder."""
    return sum(one.stat().st_size for one in [path, *path.rglob("*")] if one.is_file())


@st.composite
def recordings(draw: st.DrawFn) -> tn.Recording:
    scene = draw(st.sampled_from([SMALL, UNITLESS, DEAD]))
    frames = draw(st.integers(0, 4))
    readings = draw(arrays.arrays(np.float64, (frames, 2, 3), elements=FLOATS))
    steps = draw(arrays.arrays(np.float64, frames, elements=st.floats(0.0, 1e3)))
    t = draw(st.sampled_from([None, np.cumsum(steps)]))
    shape = (frames, draw(st.integers(1, 2)), len(scene.y))
    truth = draw(st.none() | arrays.arrays(np.float64, shape, elements=FLOATS))
    return tn.Recording(scene, readings, t, truth, tuple(draw(st.lists(st.text(st.characters(codec="utf-8"))))))


@pytest.mark.parametrize("suffix", CONTAINERS)
@given(recording=recordings())
def test_a_container_gives_back_equal_bits(
    suffix: str, recording: tn.Recording, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("saved") / f"pad{suffix}"
    recording.save(path)
    assert_same(tn.load(path), recording)
    assert [one.name for one in path.parent.iterdir()] == [path.name], "nothing is left beside it"


@given(recording=recordings())
def test_xarray_and_back(recording: tn.Recording) -> None:
    assert_same(tn.Recording.from_xarray(recording.to_xarray()), recording)


def test_a_shipped_scene_travels_with_its_files(shipped: Path, tmp_path: Path) -> None:
    recording = tn.Scene.load(shipped).simulate()
    recording.save(tmp_path / "pad.npz")
    again = tn.load(tmp_path / "pad.npz")
    assert_same(again, recording)
    assert all(np.array_equal(*both) for both in zip(again.scene.sites, recording.scene.sites))


def test_content_is_known_by_content(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.simulate()
    for suffix in (*CONTAINERS, ".npy"):
        recording.save(tmp_path / f"pad{suffix}")
        nameless = (tmp_path / f"pad{suffix}").rename(tmp_path / f"file of {suffix[1:]}")
        own = {} if suffix != ".npy" else {"scene": two, "units": "scene"}
        assert bits(tn.load(nameless, **own).readings) == bits(recording.readings)  # type: ignore[arg-type]


def test_float32_takes_half_the_space(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.replace({"time.frames": 1000}).simulate()
    for suffix in (one for one in CONTAINERS if one != ".csv"):
        sizes = []
        for dtype in ("float64", "float32"):
            recording.save(tmp_path / f"pad{suffix}", dtype=dtype)
            sizes.append(size(tmp_path / f"pad{suffix}"))
            (tmp_path / f"pad{suffix}").rename(tmp_path / f"{dtype}{suffix}")
        assert sizes[1] < 0.65 * sizes[0]
        again = tn.load(tmp_path / f"float32{suffix}")
        assert bits(again.readings) == bits(recording.readings.astype(np.float32).astype(np.float64))
        assert bits(again.t) == bits(recording.t), "times are float64 always"
    with pytest.raises(ValueError, match="readings cannot be held as float32, whose largest is 3e38"):
        dataclasses.replace(recording, readings=recording.readings * 1e60).save(tmp_path / "x.npz", dtype="float32")
    with pytest.raises(ValueError, match=r"dtype must be float64 or float32 \(got int16\)"):
        recording.save(tmp_path / "x.npz", dtype="int16")


@pytest.mark.parametrize("suffix", SOLVED)
def test_a_solution_and_back(suffix: str, two: tn.Scene, tmp_path: Path) -> None:
    readings = two.simulate().readings.copy()
    readings[2, 0, 4] = np.nan
    solution = two.solve(readings, missing="skip")
    solution.save(tmp_path / f"solved{suffix}")
    again = tn.Solution.load(tmp_path / f"solved{suffix}")
    for name in ("tractions", "alpha", "verdict", "data"):
        assert bits(getattr(again, name)) == bits(getattr(solution, name)), name
    assert (again.method, again.notes, again.verdict[2]) == ("tikhonov", solution.notes, "missing")
    assert bits(again.deviation) == bits(solution.deviation), "solved again when bands are asked for"
    assert bits(tn.load(tmp_path / f"solved{suffix}").readings) == bits(readings)
    if suffix != ".npz":  # another program reads the deviations as well
        with xarray.open_dataset(tmp_path / f"solved{suffix}") as data:
            assert data["deviation"].dims == ("t", "component", "y")
            assert np.array_equal(data["deviation"], solution.deviation, equal_nan=True)


def test_a_solution_of_fewer_tractions_than_pressed(two: tn.Scene) -> None:
    """A Dataset has one dimension of components; what was not solved for is nan in it, and is not there in the solution."""
    normal = two.replace({"reconstruct.tangential": False}).simulate().solve()
    data = normal.to_xarray()
    assert data["component"].values.tolist() == ["normal", "tangential"]
    assert np.isnan(data["tractions"].sel(component="tangential")).all()
    assert np.array_equal(data["truth"], normal.recording.truth)  # type: ignore[arg-type]
    again = tn.Solution.from_xarray(data)
    assert bits(again.tractions) == bits(normal.tractions) and again.tractions.shape[1] == 1
    with pytest.raises(tn.InputError, match="dataset: error: holds readings and no solution"):
        tn.Solution.from_xarray(normal.recording.to_xarray())


def test_a_solution_is_not_saved_where_it_cannot_be(two: tn.Scene, tmp_path: Path) -> None:
    solution = two.simulate().solve()
    for suffix in (".csv", ".npy", ".parquet"):
        with pytest.raises(ValueError, match="holds readings and no solution: .npz, .nc and .zarr hold both"):
            solution.save(tmp_path / f"x{suffix}")
    solution.recording.save(tmp_path / "x.npz")
    with pytest.raises(tn.InputError, match=r"x\.npz: error: holds readings and no solution"):
        tn.Solution.load(tmp_path / "x.npz")
    assert [one.name for one in tmp_path.iterdir()] == ["x.npz"]


@pytest.mark.parametrize("suffix", [".nc", ".zarr"])
def test_a_file_holds_many_sensors(suffix: str, two: tn.Scene, tmp_path: Path) -> None:
    left, right = two.simulate(), two.replace({"contact.0.force": 2.0}).simulate()
    path = tmp_path / f"episode{suffix}"
    left.save(path, name="left")
    right.save(path, name="right", append=True)
    for name, recording in (("left", left), ("right", right)):
        assert_same(tn.load(path, name=name), recording)
    with pytest.raises(tn.InputError, match="holds left, right\nhint: name="):
        tn.load(path)
    with pytest.raises(ValueError, match="right is in the file already"):
        left.save(path, name="right", append=True)
    assert_same(tn.load(path, name="left"), left)
    with xarray.open_dataset(path, group="left") as data:
        assert np.array_equal(data["readings"], left.readings)
    right.save(path)
    assert_same(tn.load(path), right)
    with pytest.raises(ValueError, match="its root is in the file already"):
        left.save(path, append=True)
    with pytest.raises(ValueError, match="only netCDF-4 and Zarr"):
        left.save(tmp_path / "x.npz", append=True)
    with pytest.raises(ValueError, match="letters, digits and _"):
        left.save(path, name="../left")
    assert [one.name for one in tmp_path.iterdir()] == [path.name]


def test_a_folder_that_is_no_zarr_stays(two: tn.Scene, tmp_path: Path) -> None:
    (tmp_path / "mine.zarr").mkdir()
    (tmp_path / "mine.zarr/thesis.txt").write_text("mine")
    with pytest.raises(ValueError, match="is a folder, and no Zarr"):
        two.simulate().save(tmp_path / "mine.zarr")
    assert (tmp_path / "mine.zarr/thesis.txt").read_text() == "mine"


def test_answers_and_surveys_are_datasets_on_disk(two: tn.Scene, skin: tn.Skin, tmp_path: Path) -> None:
    for name, result in (
        ("result", two.run()),
        ("skin", skin.run()),
        ("survey", two.identify()),
        ("waves", skin.identify()),
    ):
        for suffix in (".nc", ".zarr"):
            result.save(tmp_path / f"{name}{suffix}")
            with xarray.open_dataset(tmp_path / f"{name}{suffix}") as data:
                xarray.testing.assert_equal(data, result.to_xarray())
                assert data.attrs["scene"] == result.scene.text
    with pytest.raises(ValueError, match="saved as .nc, .h5, .hdf5, .zarr, not as .csv"):
        two.run().save(tmp_path / "x.csv")


def test_a_survey_as_a_dataset_says_what_its_document_says(two: tn.Scene, skin: tn.Skin) -> None:
    for scene in (two, skin):
        survey = scene.identify()
        data, told = survey.to_xarray(), survey.to_dict()
        assert data.sizes["wave"] == len(told["waves"]) and data.sizes["reading"] == len(told["wave"]["readings"])
        for k, wave in enumerate(told["waves"]):
            for part, value in wave["deviation"].items():
                found = float(data["deviation"][k].sel(traction=part))
                assert np.isnan(found) if value is None else found == value
        assert np.isinf(data["wavelength"][0]) and (np.diff(data["wavelength"][:2]) < 0).all()
        assert float(data["shortest"].sel(traction="pressure")) == survey.normal
        assert data["quantity"].values.tolist() == [one["quantity"] for one in told["wave"]["readings"]]


def test_a_long_scene_fits(two: tn.Scene, tmp_path: Path) -> None:
    long = tn.Scene.parse("# " + "x" * 200_000 + "\n" + two.text)
    for suffix in CONTAINERS:
        long.simulate().save(tmp_path / f"x{suffix}")
        assert tn.load(tmp_path / f"x{suffix}").scene.text == long.text


def test_a_full_disk_spares_what_was_there(two: tn.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recording = two.simulate()
    recording.save(tmp_path / "pad.npz")
    before = (tmp_path / "pad.npz").read_bytes()

    def full(file: Any, **arrays: Any) -> None:
        file.write(b"PK half")
        raise OSError("no space left on device")

    monkeypatch.setattr(np, "savez", full)
    with pytest.raises(OSError, match="no space"):
        recording.save(tmp_path / "pad.npz")
    assert (tmp_path / "pad.npz").read_bytes() == before and len(list(tmp_path.iterdir())) == 1


def test_a_file_is_whole_or_not_there(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.simulate()
    recording.save(tmp_path / "pad.npz")
    before = (tmp_path / "pad.npz").read_bytes()
    assert recording.t is not None
    late = dataclasses.replace(recording, t=recording.t[::-1])
    for suffix in (*CONTAINERS, ".npy"):
        with pytest.raises(ValueError, match="goes back in time: frame 1 is at 0.03 s, frame 0 at 0.04 s"):
            late.save(tmp_path / f"pad{suffix}")
    with pytest.raises(ValueError, match=r"saved as \.npy, .*, not as \.xlsx"):
        recording.save(tmp_path / "pad.xlsx")
    assert (tmp_path / "pad.npz").read_bytes() == before and len(list(tmp_path.iterdir())) == 1


def test_the_command_reads_a_csv_only_where_it_takes_its_numbers(
    two: tn.Scene, command: Callable[..., str], tmp_path: Path
) -> None:
    (tmp_path / "si.toml").write_text(two.text)
    recording = two.simulate()
    recording.save(tmp_path / "si.csv")
    command("solve", tmp_path / "si.toml", "--readings", tmp_path / "si.csv", "--json", tmp_path / "solved.json")
    assert json.loads((tmp_path / "solved.json").read_text())["frames"] == 5
    assert bits(two.read(tmp_path / "si.csv").readings) == bits(recording.readings)
    SMALL.simulate().save(tmp_path / "kpa.csv")
    with pytest.raises(tn.InputError, match="stress_x_0_in_si"):
        SMALL.read(tmp_path / "kpa.csv")
    with pytest.raises(ValueError, match="a .npy says no units, and files of readings of this scene have its own"):
        SMALL.simulate().save(tmp_path / "kpa.npy")


def test_a_dataset_may_have_its_dimensions_in_any_order(two: tn.Scene) -> None:
    recording = two.simulate()
    turned = recording.to_xarray().transpose("taxel", "channel", ...)
    assert_same(tn.Recording.from_xarray(turned), recording)


def test_its_own_csv_is_read_as_any_csv(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.simulate()
    recording.save(tmp_path / "own.csv")
    told, names, *rows = (tmp_path / "own.csv").read_text().splitlines()
    commas = [row.replace(",", ";").replace(".", ",") for row in rows]
    quoted = ",".join(f'"{name}"' for name in names.split(","))
    for lines in (
        [told, quoted, *rows],
        [told, "# of Monday", names, "", *rows],
        [told, names.replace(",", ";"), *commas],
    ):
        (tmp_path / "other.csv").write_text("\n".join(lines) + "\n")
        assert_same(tn.load(tmp_path / "other.csv"), recording)
    (tmp_path / "other.csv").write_text("\n".join([told, names, *rows]))
    with pytest.warns(tn.CutOffWarning, match=f"{len(rows) - 1} whole frames"):
        tn.load(tmp_path / "other.csv")


def test_extras_say_how_to_come_by_them(two: tn.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    recording = two.simulate()
    for module, extra, suffix in (
        ("pyarrow", "tables", ".parquet"),
        ("zarr", "zarr", ".zarr"),
        ("h5netcdf", "hdf5", ".h5"),
    ):
        monkeypatch.setitem(sys.modules, module, None)
        with pytest.raises(ImportError, match=rf"pip install {module.partition('.')[0]}, or tactile-net\[{extra}\]"):
            recording.save(tmp_path / f"x{suffix}")
    assert list(tmp_path.iterdir()) == []


def test_the_layout_is_what_the_docs_say(two: tn.Scene, tmp_path: Path) -> None:
    """Another program finds it with its own reader."""
    recording = two.simulate()
    recording.save(tmp_path / "a.nc")
    with h5py.File(tmp_path / "a.nc") as file:
        assert file["readings"].shape == (5, 2, 21) and file["t"].shape == (5,) and file["taxel"].shape == (21,)
        assert [one.decode() for one in file["channel"][()]] == ["stress_x", "shear_xy"]
        assert file.attrs["format"] == "tactile_net.readings" and file.attrs["scene"] == two.text
    recording.save(tmp_path / "a.parquet", dtype="float32")
    held = pandas.read_parquet(tmp_path / "a.parquet")
    assert list(held.columns[:43]) == ["t", *two.reading_names] and held.columns[43] == "normal_0"
    assert held["stress_x_0"].dtype == np.float32 and held.attrs["scene"] == two.text
    SMALL.simulate().save(tmp_path / "a.npz")
    with np.load(tmp_path / "a.npz") as file:
        assert json.loads(json.loads(str(file["attributes"]))["units"]) == {"stress_x": "Pa", "strain_x": "1"}


def test_recorded_files_of_the_project(tmp_path: Path) -> None:
    scene = tn.Scene.load(PROJECT / "scenes/recorded/thin-pad-counts.toml")
    path = PROJECT / "scenes/recorded/thin-pad-counts.csv"
    recording = tn.load(path, scene=scene)
    assert bits(recording.readings) == bits(scene.read(path).readings)
    recording.save(tmp_path / "counts.npz")
    assert_same(tn.load(tmp_path / "counts.npz"), recording)


def earlier_hdf5(path: Path, solution: tn.Solution) -> None:
    """As `save` of earlier versions wrote it."""
    layout = layout_of(solution)
    with h5py.File(path, "w", libver=("v108", "latest")) as file:
        group = file.create_group("observations/tactile/pad")
        for key, values in layout.arrays.items():
            if values.dtype.kind == "U":
                group.create_dataset(key, data=values.astype(object), dtype=h5py.string_dtype())
            else:
                group.create_dataset(key, data=values, compression="gzip", shuffle=True, fletcher32=True)
        group.attrs.update(layout.attributes)


def earlier_parquet(path: Path, solution: tn.Solution) -> None:
    """The same."""
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    layout = layout_of(solution)
    columns, shapes = {}, {}
    for key in ("t", "readings", "tractions", "alpha", "verdict", "data"):
        values = layout.arrays[key]
        shapes[key] = values.shape[1:]
        flat = pyarrow.array(values.reshape(-1).tolist())
        called = "observation.tactile.pad" if key == "readings" else key
        one = int(np.prod(values.shape[1:]))
        columns[called] = flat if values.ndim == 1 else pyarrow.FixedSizeListArray.from_arrays(flat, one)
    told = {"attributes": layout.attributes, "name": "pad", "shapes": shapes}
    parquet.write_table(pyarrow.table(columns).replace_schema_metadata({b"tactile_net": json.dumps(told)}), path)


def test_files_of_earlier_versions(two: tn.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    solution = two.simulate().solve()
    earlier_hdf5(tmp_path / "old.h5", solution)
    assert_same(tn.load(tmp_path / "old.h5", name="pad"), solution.recording)
    monkeypatch.chdir(tmp_path)
    earlier_parquet(tmp_path / "old.parquet", solution)
    docs = (PROJECT / "docs/logs.md").read_text(encoding="utf-8")
    (converter,) = re.findall(r"```python no-run\n(import json\n.*?)```", docs, re.DOTALL)
    exec(converter, {"np": np})
    for path in ("old.h5", "old.npz"):
        again = tn.Solution.load(path)
        assert bits(again.recording.readings) == bits(solution.recording.readings)
        assert bits(again.tractions) == bits(solution.tractions) and again.verdict.tolist() == solution.verdict.tolist()


def test_a_skins_solution_of_an_earlier_version(skin: tn.Skin, tmp_path: Path) -> None:
    """Its values and deviations stood side by side."""
    solution = skin.simulate().solve()
    solution.save(tmp_path / "new.npz")
    with np.load(tmp_path / "new.npz") as file:
        held = dict(file)
    for name in ("wrench", "ellipse"):
        both = np.stack([held[name], held.pop(f"{name}_deviation")], axis=-1)
        held[name] = both.reshape(len(both), -1)
    held["wrench"] = np.hstack([held["wrench"], np.zeros((1, 4))])  # there were angle and slip margin too
    held["covariance"] = held.pop("wrench_covariance")
    np.savez(tmp_path / "old.npz", **held)
    again = tn.Solution.load(tmp_path / "old.npz")
    for name in ("wrench", "wrench_deviation", "wrench_covariance", "ellipse", "ellipse_deviation", "touching"):
        assert bits(getattr(again, name)) == bits(getattr(solution, name)), name

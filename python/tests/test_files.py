"""Recordings on disk: every container gives back what it was given, and says what it cannot take."""

from __future__ import annotations

import dataclasses
import io
import json
import pickle
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import tactile_net as tn

h5py = pytest.importorskip("h5py")
pyarrow = pytest.importorskip("pyarrow")
parquet = pytest.importorskip("pyarrow.parquet")

CONTAINERS = (".npz", ".csv", ".h5", ".parquet")
SENSOR: dict[str, Any] = {"count": 3, "pitch": 0.5, "depth": 1.5, "reads": ["stress_x", "strain_x"]}
SMALL = tn.Scene(
    sensor=SENSOR, material={"youngs_modulus": 200.0, "poisson_ratio": 0.45}, units={"length": "mm", "stress": "kPa"}
)
UNITLESS = SMALL.replace({"units": None})
DEAD = SMALL.replace({"dead_taxels": {"indices": [1]}})
FLOATS = st.floats(width=64).map(lambda x: np.nan if np.isnan(x) else x)


def bits(array: Any) -> Any:
    return None if array is None else (array.dtype, array.shape, array.tobytes())


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


def assert_same(again: tn.Recording, recording: tn.Recording) -> None:
    for name in ("readings", "t", "truth"):
        assert bits(getattr(again, name)) == bits(getattr(recording, name)), name
    assert again.scene.text == recording.scene.text
    assert Path(again.scene.file).name == Path(recording.scene.file).name
    assert set(recording.notes) <= set(again.notes)  # what was found while reading comes after them


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
    pytest.importorskip("xarray")
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
        nameless = (tmp_path / f"pad{suffix}").rename(tmp_path / "pad.dat")
        own = {} if suffix != ".npy" else {"scene": two, "units": "scene"}
        assert bits(tn.load(nameless, **own).readings) == bits(recording.readings)  # type: ignore[arg-type]


def test_float32_takes_half_the_space(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.replace({"time.frames": 200}).simulate()
    for suffix in CONTAINERS[:1] + CONTAINERS[2:]:
        sizes = []
        for dtype in ("float64", "float32"):
            recording.save(tmp_path / f"pad{suffix}", dtype=dtype)
            sizes.append((tmp_path / f"pad{suffix}").stat().st_size)
            (tmp_path / f"pad{suffix}").rename(tmp_path / f"{dtype}{suffix}")
        assert sizes[1] < 0.65 * sizes[0]
        again = tn.load(tmp_path / f"float32{suffix}")
        assert bits(again.readings) == bits(recording.readings.astype(np.float32).astype(np.float64))
        assert bits(again.t) == bits(recording.t), "times are float64 always"
    with pytest.raises(ValueError, match="readings cannot be held as float32, whose largest is 3e38"):
        dataclasses.replace(recording, readings=recording.readings * 1e60).save(tmp_path / "x.npz", dtype="float32")
    with pytest.raises(ValueError, match=r"dtype must be float64 or float32 \(got int16\)"):
        recording.save(tmp_path / "x.npz", dtype="int16")


@pytest.mark.parametrize("suffix", [".npz", ".h5", ".parquet"])
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


def test_a_solution_is_not_saved_where_it_cannot_be(two: tn.Scene, tmp_path: Path) -> None:
    solution = two.simulate().solve()
    for suffix in (".csv", ".npy"):
        with pytest.raises(ValueError, match="holds readings and no solution: .npz"):
            solution.save(tmp_path / f"x{suffix}")
    solution.recording.save(tmp_path / "x.npz")
    with pytest.raises(tn.InputError, match=r"x\.npz: error: holds readings and no solution"):
        tn.Solution.load(tmp_path / "x.npz")
    assert [one.name for one in tmp_path.iterdir()] == ["x.npz"]


def test_an_hdf5_file_holds_many_sensors(two: tn.Scene, tmp_path: Path) -> None:
    left, right = two.simulate(), two.replace({"contact.0.force": 2.0}).simulate()
    path = tmp_path / "episode.h5"
    left.save(path, name="left")
    right.save(path, name="right", append=True)
    for name, recording in (("left", left), ("observations/tactile/right", right)):
        assert_same(tn.load(path, name=name), recording)
    with pytest.raises(tn.InputError, match="holds left, right"):
        tn.load(path)
    with pytest.raises(ValueError, match="in the file already"):
        left.save(path, name="right", append=True)
    assert_same(tn.load(path, name="left"), left)
    with pytest.raises(ValueError, match="only HDF5"):
        left.save(tmp_path / "x.npz", append=True)
    with pytest.raises(ValueError, match="letters, digits and _"):
        left.save(path, name="../left")


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


# Strangers' files.

READINGS = np.arange(24.0).reshape(4, 2, 3)
SI = READINGS * np.array([1e3, 1.0])[:, None]
"""Of kPa and of strains."""


def npz(path: Path, **held: Any) -> None:
    with open(path, "wb") as file:
        np.savez(file, **held)


def npy(path: Path, array: Any, **how: Any) -> None:
    with open(path, "wb") as file:
        np.save(file, array, **how)


def table(path: Path, **columns: Any) -> None:
    parquet.write_table(pyarrow.table(columns), path)


def hdf5(path: Path, units: str | None = None, **datasets: Any) -> None:
    with h5py.File(path, "w") as file:
        for key, values in datasets.items():
            file[key.replace("__", "/")] = values
            if units is not None and "time" not in key:
                file[key.replace("__", "/")].attrs["units"] = units


STRANGERS: dict[str, Callable[[Path], Any]] = {
    "npy": lambda path: npy(path, READINGS),
    "npy, big-endian, Fortran": lambda path: npy(path, np.asfortranarray(READINGS.reshape(4, 6)).astype(">f4")),
    "npz": lambda path: npz(path, readings=READINGS, other=np.zeros(3)),
    "npz, its only array": lambda path: npz(path, skin=READINGS.reshape(4, 6), timestamp=np.arange(4) * 0.1),
    "hdf5": lambda path: hdf5(
        path, observations__tactile__pad=READINGS, observations__tactile__time=np.arange(4) * 0.1
    ),
    "parquet, lists": lambda path: table(path, taxels=READINGS.reshape(4, 6).tolist(), timestamp=np.arange(4) * 0.1),
    "parquet, wide": lambda path: table(
        path, t=np.arange(4) * 0.1, **{f"s_{k}": READINGS.reshape(4, 6)[:, k] for k in range(6)}
    ),
    "csv": lambda path: path.write_text(
        ",".join(SMALL.reading_names) + "\n" + "\n".join(",".join(map(str, row)) for row in READINGS.reshape(4, 6))
    ),
}


@pytest.mark.parametrize("make", STRANGERS.values(), ids=STRANGERS.keys())
def test_a_strangers_file_is_taken_with_a_scene_and_units(make: Callable[[Path], Any], tmp_path: Path) -> None:
    path = tmp_path / "mine"
    make(path)
    with pytest.raises(tn.InputError, match=r"mine: error: says no scene that its readings are of\nhint: give scene="):
        tn.load(path)
    with pytest.raises(
        tn.InputError, match="says no units of its readings, and neither does the scene\nhint: give units="
    ):
        tn.load(path, scene=UNITLESS)
    assert np.array_equal(tn.load(path, scene=UNITLESS, units="scene").readings, READINGS)
    for units in (None, "scene", "kPa", {"stress_x": "kPa", "strain_x": "1"}):
        assert np.array_equal(tn.load(path, scene=SMALL, units=units).readings, SI)
    assert np.array_equal(tn.load(path, scene=SMALL, units="SI").readings, READINGS)
    dead = tn.load(path, scene=DEAD, units="kPa").readings
    assert (dead[:, :, 1] == 0).all() and np.array_equal(dead[:, :, ::2], SI[:, :, ::2])
    with pytest.raises(tn.InputError, match="states the unit 'furlong' of stress_x\nhint: units that are known: .*kPa"):
        tn.load(path, scene=SMALL, units="furlong")
    with pytest.raises(tn.InputError, match="is in kPa, and the scene does not say what it is in\nhint: .*units"):
        tn.load(path, scene=UNITLESS, units="kPa")
    with pytest.raises(tn.InputError, match="has units of stress_y, and the scene reads stress_x, strain_x"):
        tn.load(path, scene=SMALL, units={"stress_y": "kPa"})


def test_columns_are_found_by_the_names_of_the_scene(tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    frame = tn.Recording(SMALL, READINGS, np.arange(4) * 0.1).to_dataframe()
    frame[sorted(frame.columns, reverse=True)].to_parquet(tmp_path / "a")
    recording = tn.load(tmp_path / "a", scene=SMALL, units="SI")
    assert np.array_equal(recording.readings, READINGS) and np.array_equal(recording.t, np.arange(4) * 0.1)  # type: ignore[arg-type]


def test_a_dataset_may_have_its_dimensions_in_any_order(two: tn.Scene) -> None:
    pytest.importorskip("xarray")
    recording = two.simulate()
    turned = recording.to_xarray().transpose("taxel", "channel", ...)
    assert_same(tn.Recording.from_xarray(turned), recording)


def test_units_that_a_file_states_count(tmp_path: Path) -> None:
    stresses = SMALL.replace({"sensor.reads": ["stress_x", "stress_y"]})
    hdf5(tmp_path / "a.h5", units="mbar", skin=READINGS)
    assert np.array_equal(tn.load(tmp_path / "a.h5", scene=stresses).readings, READINGS * 100)
    with pytest.raises(tn.InputError, match="states the unit 'mbar', and units='kPa' was given"):
        tn.load(tmp_path / "a.h5", scene=stresses, units="kPa")
    saved(tmp_path / "b", ".npz")
    with pytest.raises(tn.InputError, match="states the units of its readings\nhint: leave units= out"):
        tn.load(tmp_path / "b.npz", units="kPa")


def test_times_are_seconds(tmp_path: Path) -> None:
    stamps = np.array(["2026-01-01T00:00:00.5", "2026-01-01T00:00:00.75"], dtype="datetime64[ns]")
    table(tmp_path / "a", t=stamps, taxels=READINGS[:2].reshape(2, 6).tolist())
    t = tn.load(tmp_path / "a", scene=SMALL).t
    assert t is not None and np.array_equal(t, [1767225600.5, 1767225600.75])
    whole = stamps.astype(np.int64)
    for unit, digits in (("ns", 1), ("us", 10**3), ("ms", 10**6)):
        npz(tmp_path / unit, readings=READINGS[:2], timestamp=whole // digits)
        recording = tn.load(tmp_path / unit, scene=SMALL)
        assert recording.t is not None and np.allclose(recording.t, t, rtol=0, atol=1e-6)
        assert recording.notes == ()
    npz(tmp_path / "count", readings=READINGS, t=np.arange(4))
    (note,) = tn.load(tmp_path / "count", scene=SMALL).notes
    assert "no stated unit" in note


def test_counts_of_a_converter_need_what_one_of_them_is(tmp_path: Path) -> None:
    counts = (100 * READINGS).astype(np.uint16)
    npz(tmp_path / "a", readings=counts)
    with pytest.raises(
        tn.InputError, match=r"whole numbers \(uint16\), as a converter gives, .*\nhint: .*\[calibration\]"
    ):
        tn.load(tmp_path / "a", scene=SMALL)
    scaled = SMALL.replace({"calibration": {"gain": {"stress_x": 0.01, "strain_x": 0.01}, "baseline": 5.0}})
    assert np.allclose(tn.load(tmp_path / "a", scene=scaled).readings, SI - np.array([50.0, 0.05])[:, None], rtol=1e-12)
    assert np.array_equal(tn.load(tmp_path / "a", scene=SMALL, units="kPa").readings[:, 0], 1e5 * READINGS[:, 0])


def test_frames_that_are_missing_are_told(tmp_path: Path) -> None:
    readings = READINGS.copy()
    readings[2, 1, 0], readings[3, 0, 1] = np.nan, np.inf
    npz(tmp_path / "a", readings=readings, t=np.array([0.0, 0.1, 0.1, 0.4]))
    recording = tn.load(tmp_path / "a", scene=SMALL)
    assert np.isnan(recording.readings).sum() == 2
    assert recording.notes == (
        "1 frame at the time of the one before, the first is frame 2",
        "2 frames with readings that are missing, the first: frame 2, strain_x_0 (nan)",
    )
    with pytest.raises(tn.InputError, match=r"frame 2, strain_x_0 \(nan\) is not finite"):
        tn.load(tmp_path / "a", scene=SMALL, missing=False)
    readings[2, 1, 0] = 0.0
    npz(tmp_path / "a", readings=readings)
    for units in ("scene", "kPa"):  # a dead taxel may be anything
        assert tn.load(tmp_path / "a", scene=DEAD, units=units, missing=False).notes == ()
    tn.Recording(DEAD, np.where(np.isinf(readings), np.nan, readings)).save(tmp_path / "own.npz")
    assert tn.load(tmp_path / "own.npz", missing=False).notes == ()


def test_gaps_in_time_are_counted(tmp_path: Path) -> None:
    t = np.delete(np.arange(60) * 0.01, [7, 8, 30])
    npz(tmp_path / "a", readings=np.zeros((57, 6)), t=t)
    (note,) = tn.load(tmp_path / "a", scene=SMALL).notes
    assert note == "2 gaps in time, about 3 frames missing at 0.01 s a frame; the longest lasts 0.03 s, after frame 6"


def saved(path: Path, suffix: str) -> bytes:
    """Of 50 frames."""
    recording = tn.Recording(SMALL, np.random.default_rng(1).normal(size=(50, 2, 3)), np.arange(50) * 0.01)
    recording.save(path.with_suffix(suffix))
    return path.with_suffix(suffix).read_bytes()


def zipped(path: Path, name: str) -> None:
    with zipfile.ZipFile(path, "w") as file:
        file.writestr(name, "x")


def tampered(path: Path, truth: Any = None, **attributes: str) -> None:
    saved(path, ".npz")
    with np.load(path.with_suffix(".npz")) as file:
        held = dict(file) | ({} if truth is None else {"truth": truth})
    npz(path, **held | {"attributes": np.array(json.dumps(json.loads(str(held["attributes"])) | attributes))})


BAD: dict[str, tuple[Callable[[Path], Any], str]] = {
    "channels first": (
        lambda path: npz(path, readings=np.zeros((2, 50, 3))),
        r"the shape \(2, 50, 3\), not \(frames, 2, 3\)\nhint: its axes are exchanged: readings.transpose\(1, 0, 2\)",
    ),
    "taxels before channels": (
        lambda path: npy(path, np.zeros((50, 3, 2))),
        r"the shape \(50, 3, 2\), not \(frames, 2, 3\)\nhint: its axes are exchanged: readings.transpose\(0, 2, 1\)",
    ),
    "a reading a row": (
        lambda path: npz(path, readings=np.zeros((6, 50))),
        r"the shape \(6, 50\), not \(frames, 2, 3\)\nhint: rows and columns are exchanged: readings.T",
    ),
    "another sensor": (
        lambda path: hdf5(path, readings=np.zeros((50, 2, 4))),
        r"the shape \(50, 2, 4\), not \(frames, 2, 3\)\nhint: or \(frames, 6\)",
    ),
    "times that go back": (
        lambda path: npz(path, readings=READINGS, t=np.array([0.0, 0.2, 0.1, 0.3])),
        "goes back in time: frame 2 is at 0.1 s, frame 1 at 0.2 s\nhint: sort",
    ),
    "times of other frames": (
        lambda path: npz(path, readings=READINGS, t=np.arange(3.0)),
        r"has 4 frames and times of the shape \(3,\)",
    ),
    "objects": (
        lambda path: npy(path, np.array([{}]), allow_pickle=True),
        "holds Python objects, which can run anything when they are loaded\nhint: .*astype",
    ),
    "objects in an archive": (
        lambda path: npz(path, readings=np.array([{}])),
        "readings: holds Python objects, which can run anything",
    ),
    "a pickle": (lambda path: path.write_bytes(pickle.dumps(READINGS)), "is a Python pickle"),
    "complex numbers": (lambda path: npy(path, READINGS + 0j), "has readings that are complex128, not plain numbers"),
    "text": (lambda path: npz(path, readings=np.array(["a"])), "has readings that are <U1, not plain numbers"),
    "an empty file": (lambda path: path.write_bytes(b""), "is empty"),
    "compressed text": (lambda path: path.write_bytes(b"\x1f\x8b\x08rest"), "is compressed by gzip: gunzip it"),
    "no name": (
        lambda path: npz(path, a=READINGS, b=READINGS),
        r"does not say which of them is the readings; arrays: a \(4, 2, 3\), b \(4, 2, 3\)\nhint: name=",
    ),
    "a spreadsheet": (
        lambda path: zipped(path, "sheet.xml"),
        "is a zip archive without arrays, as .xlsx files are\nhint: save the sheet as CSV",
    ),
    "lists of different lengths": (
        lambda path: table(path, taxels=[[1.0], [2.0, 3.0]]),
        "has lists of different lengths in 'taxels'",
    ),
    "half a .npz": (
        lambda path: path.write_bytes(saved(path, ".npz")[:700]),
        "is not a whole .npz file: .*\nhint: its table",
    ),
    "half an HDF5 file": (lambda path: path.write_bytes(saved(path, ".h5")[:7000]), "is not a whole HDF5 file: "),
    "half a Parquet file": (
        lambda path: path.write_bytes(saved(path, ".parquet")[:700]),
        "is not a whole Parquet file: .*\nhint: its table",
    ),
    "a header alone": (lambda path: path.write_bytes(b"\x93NUMPY\x01\x00"), "has a header that cannot be read"),
    "less than a frame": (
        lambda path: path.write_bytes(_npy_bytes(READINGS)[:140]),
        r"ends before the first whole frame of \(4, 2, 3\)",
    ),
    "more than its frames": (
        lambda path: path.write_bytes(_npy_bytes(READINGS) + b"x"),
        r"goes on after the array of shape \(4, 2, 3\)",
    ),
    "a scene that was changed": (
        lambda path: tampered(path, scene=SMALL.text + "\n"),
        "its SHA-256 differs\nhint: give scene=",
    ),
    "a later version": (
        lambda path: tampered(path, version="2"),
        "is of version 2 of the layout, and versions up to 1",
    ),
    "no readings": (
        lambda path: npz(path, attributes=np.array(json.dumps({"format": "tactile_net.readings"}))),
        "is not of the layout that it says it is: KeyError|has a scene inside that is not the one",
    ),
    "a truth of another surface": (
        lambda path: tampered(path, scene=SMALL.text, truth=np.zeros((50, 1, 4))),
        r"has a truth of the shape \(50, 1, 4\), not \(50, components, 3\)",
    ),
    "units that are no JSON": (
        lambda path: tampered(path, units="kPa"),
        "is not of the layout that it says it is: JSON",
    ),
    "units of another sensor": (
        lambda path: tampered(path, units='{"stress_y": "Pa"}'),
        "has units of stress_y, and the scene reads stress_x, strain_x",
    ),
    "a version that is none": (lambda path: tampered(path, version="new"), "is not of the layout .*: ValueError"),
    "columns in no order": (
        lambda path: table(path, **{f"s_{k}": READINGS[:, 0, 0] for k in (0, 1, 10, 2, 3, 4)}),
        "has readings in columns whose order is not clear: s_0, s_1, s_10, s_2, ...\nhint: name them as the scene does, str",
    ),
    "files that lead elsewhere": (
        lambda path: tampered(path, scene_files=json.dumps({"../x.csv": "y"})),
        "'../x.csv' leads out of the scene's folder",
    ),
}


def _npy_bytes(array: Any) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


STARTS = [
    b"",
    b"\x93NUMPY\x01\x00",
    b"PK\x03\x04",
    b"\x89HDF\r\n\x1a\n",
    b"PAR1",
    b"# tactile_net ",
    b"\x89MCAP0\r\n",
    b"#ROSBAG V2.0\n",
]


@pytest.mark.parametrize(("make", "words"), BAD.values(), ids=BAD.keys())
def test_bad_files_are_refused_in_a_sentence(make: Callable[[Path], Any], words: str, tmp_path: Path) -> None:
    path = tmp_path / "bad"
    make(path)
    own = any(word in words for word in ("SHA", "version", "leads", "layout", "units of", "truth"))
    with pytest.raises(tn.InputError, match=words) as caught:
        tn.load(path, scene=None if own else SMALL)
    assert str(caught.value).startswith(f"{path}: error: ")


def test_no_array_of_that_name(tmp_path: Path) -> None:
    npz(tmp_path / "a", skin=READINGS)
    with pytest.raises(tn.InputError, match=r"has no array 'pad'; arrays: skin \(4, 2, 3\)"):
        tn.load(tmp_path / "a", scene=SMALL, name="pad")
    with pytest.raises(FileNotFoundError):
        tn.load(tmp_path / "nothing", scene=SMALL)


def test_what_is_whole_of_a_file_is_given_with_the_count(tmp_path: Path) -> None:
    text = saved(tmp_path / "x", ".csv")
    (tmp_path / "half.csv").write_bytes(text[: len(text) * 3 // 4])
    whole = text[: len(text) * 3 // 4].count(b"\n") - 2
    with pytest.warns(tn.CutOffWarning, match=rf"half\.csv: cut off: {whole} whole frames, then line {whole + 3}"):
        recording = tn.load(tmp_path / "half.csv")
    assert len(recording) == whole and 20 < whole < 50 and "cut off" in recording.notes[0]
    (tmp_path / "half.csv").write_bytes(b"".join(text.splitlines(keepends=True)[:12]))
    with pytest.warns(
        tn.CutOffWarning, match="cut off: 10 whole frames, then the end of the file; it was of 50 frames"
    ):
        assert len(tn.load(tmp_path / "half.csv")) == 10
    (tmp_path / "half.npy").write_bytes(_npy_bytes(READINGS)[:-50])
    with pytest.warns(
        tn.CutOffWarning, match="cut off: 2 whole frames, then the end of the file; its header tells of 4"
    ):
        assert np.array_equal(tn.load(tmp_path / "half.npy", scene=SMALL).readings, SI[:2])


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


@given(data=st.binary(max_size=300), start=st.sampled_from(STARTS))
def test_any_bytes_are_a_recording_or_refused(
    data: bytes, start: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("any") / "file"
    path.write_bytes(start + data)
    with pytest.raises(tn.InputError):
        tn.load(path, scene=SMALL)


def test_extras_say_how_to_come_by_them(two: tn.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    recording = two.simulate()
    for module, extra, suffix in (
        ("h5py", "hdf5", ".h5"),
        ("pyarrow", "tables", ".parquet"),
        ("mcap.writer", "logs", ".mcap"),
    ):
        monkeypatch.setitem(sys.modules, module, None)
        with pytest.raises(ImportError, match=rf"pip install {module.partition('.')[0]}, or tactile-net\[{extra}\]"):
            recording.save(tmp_path / f"x{suffix}")
    assert list(tmp_path.iterdir()) == []


def test_the_layout_is_what_the_docs_say(two: tn.Scene, tmp_path: Path) -> None:
    """Another program finds it with its own reader."""
    recording = two.simulate()
    recording.save(tmp_path / "a.h5")
    with h5py.File(tmp_path / "a.h5") as file:
        group = file["observations/tactile/pad"]
        assert group["readings"].shape == (5, 2, 21) and group["t"].shape == (5,) and group["y"].shape == (21,)
        assert [one.decode() for one in group["channels"][()]] == ["stress_x", "shear_xy"]
        assert group.attrs["format"] == "tactile_net.readings" and group.attrs["scene"] == two.text
    recording.save(tmp_path / "a.parquet", dtype="float32", name="left")
    held = parquet.read_table(tmp_path / "a.parquet")
    assert held.column_names == ["t", "observation.tactile.left", "truth"]
    assert str(held.schema.field(1).type) == "fixed_size_list<element: float>[42]"
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

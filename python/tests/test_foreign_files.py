"""Files that others wrote are recordings with a scene and units, or are refused with what to do."""

from __future__ import annotations

import json
import pickle
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from recordings import DEAD, READINGS, SI, SMALL, UNITLESS, npy, npy_bytes, npz, saved

import tactile_net as tn

h5py = pytest.importorskip("h5py")
pytest.importorskip("h5netcdf")
pyarrow = pytest.importorskip("pyarrow")
parquet = pytest.importorskip("pyarrow.parquet")


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
        lambda path: path.write_bytes(npy_bytes(READINGS)[:140]),
        r"ends before the first whole frame of \(4, 2, 3\)",
    ),
    "more than its frames": (
        lambda path: path.write_bytes(npy_bytes(READINGS) + b"x"),
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


STARTS = [
    b"",
    b"\x93NUMPY\x01\x00",
    b"PK\x03\x04",
    b"\x89HDF\r\n\x1a\n",
    b"PAR1",
    b"# tactile_net ",
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
    (tmp_path / "half.npy").write_bytes(npy_bytes(READINGS)[:-50])
    with pytest.warns(
        tn.CutOffWarning, match="cut off: 2 whole frames, then the end of the file; its header tells of 4"
    ):
        assert np.array_equal(tn.load(tmp_path / "half.npy", scene=SMALL).readings, SI[:2])


@given(data=st.binary(max_size=300), start=st.sampled_from(STARTS))
def test_any_bytes_are_a_recording_or_refused(
    data: bytes, start: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("any") / "file"
    path.write_bytes(start + data)
    with pytest.raises(tn.InputError):
        tn.load(path, scene=SMALL)



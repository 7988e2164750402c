"""Tac3D: its recorder, from its wheel alone, and its recordings, which are fetched and not kept."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray
from sensor_pads import SOFT

import tactile_net as tn
from tactile_net import sensors


def tac3d_frames(count: int = 6) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Rest places of 20 x 20 markers on a dome [mm], and displacements [mm]."""
    angle = np.linspace(-0.3, 0.3, 20)
    ray = np.array([[np.tan(a), np.tan(b), 1.0] for a in angle for b in angle])
    rest = 30.0 * ray / np.linalg.norm(ray, axis=1, keepdims=True)
    moved = np.zeros((count, 400, 3))
    moved[1:] = -0.2 * np.exp(-((rest[:, :1] ** 2 + rest[:, 1:2] ** 2) / 8.0)) * [0.0, 0.0, 1.0]
    return rest, moved


@pytest.fixture(scope="session")
def pytac3d(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Its wheel, of this session alone: it states no licence, so that nothing of it is kept."""
    folder = tmp_path_factory.mktemp("pytac3d")
    fetch = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", str(folder), "PyTac3D==3.3.0.9"]
    try:
        done = subprocess.run(fetch, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        pytest.skip("PyTac3D's wheel cannot be fetched: no answer")
    wheels = list(folder.glob("*.whl"))
    if done.returncode != 0 or not wheels:
        pytest.skip(f"PyTac3D's wheel cannot be fetched: {done.stderr.strip().splitlines()[-1:]}")
    with zipfile.ZipFile(wheels[0]) as file:
        names = [one for one in file.namelist() if one == "PyTac3D/Data.py" or "/example_data/" in one]
        file.extractall(folder, names)
    yield folder / "PyTac3D"
    for one in sorted(folder.rglob("*"), reverse=True):
        one.rmdir() if one.is_dir() else one.unlink()


def module_of(file: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(file.stem, file)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_tac3d(pytac3d: Path, tmp_path: Path) -> None:
    rest, moved = tac3d_frames()
    recorder = module_of(pytac3d / "Data.py").DataRecorder("AB1")
    for k, one in enumerate(moved):
        recorder.put(
            {
                "SN": "AB1",
                "index": k,
                "sendTimestamp": 5.0 + k / 30,
                "3D_Positions": rest + one,
                "3D_Displacements": one,
            }
        )
    recorder.save(str(tmp_path))
    assert list(sensors.sniffed(tmp_path)) == ["tac3d"] == list(sensors.sniffed(tmp_path / "AB1"))
    taken = tn.load(tmp_path, **SOFT)
    assert np.allclose(taken.geometry.positions, 1e-3 * rest, atol=1e-12)
    assert np.array_equal(taken.frames.readings, 1e-3 * moved) and taken.frames.units == "m"
    assert taken.frames.t is not None and np.allclose(taken.frames.t, 5.0 + np.arange(6) / 30)
    radial = rest / np.linalg.norm(rest, axis=1, keepdims=True)
    assert np.einsum("ij,ij->i", taken.geometry.normals, radial).min() > np.cos(np.radians(0.5))
    assert any("1 of 6 frames have no displacement at all" in one for one in taken.notes)
    assert taken.tables()["sensor"]["frame"] == "sensor"
    (tmp_path / "AB1/3D_Positions.npy").unlink()
    with pytest.raises(tn.InputError, match="has no 3D_Positions.npy"):
        tn.load(tmp_path, sensor="tac3d", **SOFT)


def folders_of(pytac3d: Path) -> list[Path]:
    """Of its three recordings."""
    found = [one.parent for one in sorted((pytac3d / "example_data").rglob("3D_Displacements.npy"))]
    assert len(found) == 3
    return found


def some_of(taken: sensors.SensorRecording, frames: NDArray[np.int_]) -> sensors.SensorRecording:
    few = tn.Frames(taken.frames.readings[frames], units="m")
    return sensors.SensorRecording(taken.sensor, taken.path, taken.geometry, few, taken.pad)


def errors_of(found: NDArray[np.float64], makers: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of every other frame, after the modulus that the frames between them have."""
    scale = (found[::2] * makers[::2]).sum() / (found[::2] ** 2).sum()
    return np.asarray(np.linalg.norm(scale * found - makers, axis=1)[1::2] / np.linalg.norm(makers, axis=1)[1::2])


def test_the_recordings_of_tac3d(pytac3d: Path) -> None:
    """Domes of about 30 mm. No frame of them is told."""
    for folder in folders_of(pytac3d):
        taken = tn.load(folder, **SOFT)
        assert taken.tables()["surface"]["shape"] == "sphere"
        assert len(taken.geometry) == 400 and taken.frames.readings.shape[1:] == (400, 3)
        sphere = np.column_stack([2 * taken.geometry.positions, np.ones(400)])
        found = np.linalg.lstsq(sphere, (taken.geometry.positions**2).sum(axis=1), rcond=None)[0]
        radius = float(np.sqrt(found[3] + found[:3] @ found[:3]))
        assert 0.025 < radius < 0.04
        radial = (taken.geometry.positions - found[:3]) / radius
        assert np.median(np.einsum("ij,ij->i", taken.geometry.normals, radial)) > 0.999, "normals lead out of the ball"
    with pytest.raises(tn.InputError, match="has 2 sensors"):
        tn.load(folder.parent, **SOFT)


@pytest.mark.parametrize(("which", "most"), [(0, 0.12), (1, 0.05), (2, 0.05)])
def test_forces_of_the_recordings_of_tac3d(which: int, most: float, pytac3d: Path) -> None:
    """The maker's resultants after one modulus, with nothing said but the pad; the first recording bends the dome by far more
    than the model's small displacements. What is not moved has no force, and forces and moments are those of the cells."""
    folder = folders_of(pytac3d)[which]
    taken = tn.load(folder, **SOFT)
    makers = np.load(folder / "3D_ResultantForce.npy")[:, 0]
    pressed = np.flatnonzero(np.linalg.norm(makers, axis=1) > 1.0)[::4]
    still = np.flatnonzero(np.abs(taken.frames.readings).max(axis=(1, 2)) == 0.0)[:2]
    solution = some_of(taken, np.concatenate([pressed, still])).solve()
    moved = slice(0, len(pressed))
    assert np.median(errors_of(solution.force[moved], makers[pressed])) <= most
    assert np.abs(solution.force[len(pressed) :]).max(initial=0.0) == 0.0
    assert which != 0 or len(still) == 2
    if which > 0:
        assert not (solution.data == "implausible").any(), "a marker moves by more than its depth, and less than the pad is thick"
    surface = solution.surface
    assert surface is not None
    on_cells = np.einsum("tuc,cux->tcx", solution.tractions.reshape(len(solution), 3, -1), surface.forces)
    scale = np.linalg.norm(solution.force[moved], axis=1).max()
    points = solution.to_point_set("isaac").values
    assert np.abs(points.sum(axis=1) - solution.force).max() < 1e-10 * scale
    counted = solution.touching.reshape(len(solution), -1, 1)
    whole = np.where(counted.any(axis=1), np.where(counted, on_cells, 0.0).sum(axis=1), on_cells.sum(axis=1))
    assert np.abs(whole - solution.force).max() < 0.05 * scale, "but for what is corrected of it"


def test_cones_over_a_recording_of_tac3d(pytac3d: Path) -> None:
    """Under a friction limit nothing pulls, and the force is the maker's within 8 %."""
    folder = folders_of(pytac3d)[1]
    taken = tn.load(folder, **SOFT)
    makers = np.load(folder / "3D_ResultantForce.npy")[:, 0]
    pressed = np.flatnonzero(np.linalg.norm(makers, axis=1) > 1.0)[::30]
    solution = some_of(taken, pressed).solve({"reconstruct.friction_limit": 0.9})
    assert solution.normal.min() >= 0.0
    drag = np.linalg.norm(solution.tangential, axis=1)
    assert (drag <= 0.9 * solution.normal * (1 + 1e-9) + 1e-9 * solution.normal.max()).all()
    assert np.median(errors_of(solution.force, makers[pressed])) <= 0.08

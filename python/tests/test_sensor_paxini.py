"""PaXini: files of its recorder, the taxels of its models, and presses on each of them."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from ball_layer import press_on
from sensor_pads import PAD, lattice_skin

import tactile_net as tn
from tactile_net import sensors

RNG = np.random.default_rng(42)
MODELS = sensors.models("paxini")


class PaxiniConfig:
    """What the recorder asks of the board."""

    has_resultant, has_distributed = True, True

    def __init__(self, points: dict[int, int]) -> None:
        self.active_modules = sorted(points)
        self.point_counts = points


@pytest.mark.parametrize("form", ["vendor", "native"])
def test_paxinis_recorder(form: str, tmp_path: Path) -> None:
    recording = pytest.importorskip("paxini_sdk.recording", reason="paxini-sdk is not installed")
    registers = pytest.importorskip("paxini_sdk.registers")
    counts = RNG.integers([-100, -100, 0], [100, 100, 256], size=(5, 135, 3))
    config = PaxiniConfig({6: 135})
    path = tmp_path / "run.csv"
    with recording.CsvRecorder(path, config, format=form, sensor_part="PXSR-STDDP03A") as recorder:
        for frame in counts:
            name = registers.MODULE_NAMES[6]
            told = type(
                "Frame", (), {"resultant_forces": {name: (1, 2, 3)}, "distributed_forces": {name: frame.tolist()}}
            )
            recorder.write(told)
    assert list(sensors.sniffed(path)) == ["paxini"]
    taken = tn.load(path, **PAD)
    assert taken.sensor == "paxini" and taken.frames.units == "N" and taken.frames.frame == "local"
    assert np.allclose(taken.frames.readings[..., 0], 0.1 * counts[..., 2], atol=1e-12)
    assert np.array_equal(taken.geometry.positions, MODELS["PXSR-STDDP03A"].positions)
    assert taken.frames.noise == pytest.approx(0.1 / 12**0.5)
    assert any("normals are fitted" in one for one in taken.notes)
    assert any("only one of 135 points" in one for one in taken.notes) == (form == "vendor")
    assert taken.frames.t is not None and (np.diff(taken.frames.t) >= 0.0).all()
    # From the middle of the points outward, and neighbours alike.
    away = taken.geometry.positions - taken.geometry.positions.mean(axis=0)
    assert (np.einsum("ij,ij->i", away, taken.geometry.normals) > 0.0).mean() > 0.95
    along = tn.sensors.frames(path, frame="sensor")
    assert np.allclose(along.readings, 0.1 * counts * [1, 1, -1], atol=1e-12)
    turned = tn.sensors.frames(path, frame="sensor", gain=(-1, -1, 1))
    assert np.allclose(turned.readings, -along.readings * [1, 1, -1], atol=1e-12)
    # Not of this model, not of this module.
    with pytest.raises(tn.InputError, match="has 135 points in module .*, and PXSR-STDDP03B has 127"):
        tn.load(path, model="PXSR-STDDP03B", **PAD)
    with pytest.raises(tn.InputError, match="is of no model 'finger'"):
        tn.load(path, model="finger", **PAD)
    with pytest.raises(tn.InputError, match="has no module 'thumb'"):
        tn.load(path, name="thumb", **PAD)


def test_paxinis_modules_and_midnight(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    rows = [["Timestamp", *(f"{m}-2-NxN-{a}[{k}]" for m in (0, 1) for k in range(9) for a in "XYZ")]]
    rows += [[time, *range(54)] for time in ("23:59:59.900", "00:00:00.100")]
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows(rows)
    with pytest.raises(tn.InputError, match=r"2 modules: 0-2, 1-2[\s\S]*name="):
        tn.load(path, **PAD)
    taken = tn.load(path, name="1-2", **PAD)
    assert taken.geometry.flat and len(taken.geometry) == 9
    assert taken.frames.t is not None and np.allclose(np.diff(taken.frames.t), 0.2)
    path.write_text(path.read_text().replace("1-2-NxN-Y[3]", "other"))
    with pytest.raises(tn.InputError, match="has not X, Y and Z of each point of module 1-2"):
        tn.load(path, name="1-2", **PAD)


def test_counts_beyond_paxinis_range_are_refused(tmp_path: Path) -> None:
    counts = np.zeros(9, dtype=int)
    taken = tn.load(recorded(tmp_path / "still.csv", counts), sensor="paxini", **PAD)
    assert not any("end of their range" in one for one in taken.notes)
    counts[4] = 255
    taken = tn.load(recorded(tmp_path / "hard.csv", counts), sensor="paxini", **PAD)
    assert any(one.startswith("1 frame with counts at the end of their range") for one in taken.notes)
    for wrong in (256, -1):
        counts[4] = wrong
        with pytest.raises(tn.InputError, match=f"has {wrong} in a column of Z, where counts are from 0 to 255"):
            tn.load(recorded(tmp_path / "wrong.csv", counts), sensor="paxini", **PAD)


def test_a_flat_paxini_is_solved(tmp_path: Path) -> None:
    """The palm's nine points, 4.1 mm apart: the answer is that of a skin of the same rows and columns."""
    path = tmp_path / "palm.csv"
    skin = lattice_skin(3, 3, 4.085e-3, 20.0)
    counts = np.rint(10 * 4.085e-3**2 * skin.simulate().readings.ravel()).astype(int)
    assert 100 < counts.max() < 256
    header = ["Timestamp", *(f"5-0-NxN-{a}[{k}]" for k in range(9) for a in "XYZ")]
    body = [["10:00:00.000", *(one for count in counts for one in (0, 0, count))]]
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([header, *body])
    solution = tn.load(path, sensor="paxini", model="PXSR-STDMC03A", **PAD).solve()
    same = skin.replace({"noise": {"rms": 0.1 / 12**0.5 / 4.085e-3**2}}).solve(
        0.1 / 4.085e-3**2 * counts[np.newaxis].astype(float)
    )
    assert solution.normal_force[0] == pytest.approx(same.normal_force[0], rel=0.1)
    points = solution.to_point_set("isaac")
    assert points.values[0, :, 2].sum() == pytest.approx(-solution.normal_force[0], rel=1e-12)


def test_the_taxels_are_those_of_paxinis_sdk() -> None:
    """Places of its registry, and normals of the quadrics that `Geometry` fits."""
    registry = pytest.importorskip("paxini_sdk.sensor_registry", reason="paxini-sdk is not installed")
    theirs = {one.vendor_part_code: np.array(registry.load_points(one)) for one in registry.list_sensors()}
    assert theirs.keys() == MODELS.keys()
    for model, points in theirs.items():
        fitted = tn.Geometry(1e-3 * points)
        assert np.allclose(MODELS[model].positions, fitted.positions, rtol=1e-14, atol=0.0)
        assert np.allclose(MODELS[model].normals, fitted.normals, rtol=0.0, atol=1e-9)


def recorded(path: Path, counts: NDArray[np.int_]) -> Path:
    """As the maker's program writes z counts of one frame."""
    header = ["Timestamp", *(f"5-0-NxN-{axis}[{k}]" for k in range(len(counts)) for axis in "XYZ")]
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([header, ["10:00:00.000", *(one for count in counts for one in (0, 0, count))]])
    return path


def pressed(recording: sensors.SensorRecording, force: float) -> tuple[NDArray[np.int_], NDArray[np.float64]]:
    """Counts of a ball that presses the middle, as the recording's own scene reads it, and the force along the sensor's axes."""
    middle = [0.0, 0.0]
    if recording.geometry.flat:
        middle = (recording.geometry.positions.mean(axis=0) @ recording.flat_frame[1:].T).tolist()
    skin = recording.scene({"contact": [{"shape": "sphere", "place": middle, "radius": 3e-3, "force": force}]})
    made = skin.simulate()
    by_name = dict(zip(skin.reading_names, made.readings.ravel()))
    stress = np.array([by_name[f"stress_x_{name}"] for name in recording.geometry.names])
    assert made.truth is not None
    pressure = made.truth[0, 0].ravel()
    flat = np.broadcast_to(skin.cell_area * recording.local_frames[0, 0], (pressure.size, 3))
    vectors = flat if skin.surface is None else skin.surface.forces[:, 0]
    return np.rint(10 * stress * recording.geometry.areas).clip(0, 255).astype(int), np.asarray(pressure @ vectors)


@pytest.mark.parametrize("model", sorted(MODELS))
def test_a_press_on_each_model(model: str, tmp_path: Path) -> None:
    """Of 10 N above a point in the middle, under 2 mm: counts by a series of its own on the ball through the point's neighbours,
    nothing of which the library made. The force comes back within three deviations and a quarter, in size and as a vector."""
    pad = PAD | {"thickness": 2e-3}
    points = MODELS[model].positions
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1)) if MODELS[model].flat else MODELS[model].normals
    middle = normals.mean(axis=0) / np.linalg.norm(normals.mean(axis=0))
    facing = normals @ middle > np.cos(np.radians(40.0))
    away = np.linalg.norm(points - points[facing].mean(axis=0), axis=1)
    at = int(np.argmin(np.where(facing, away, np.inf)))
    stress, force = press_on(points, normals, at, 10.0, pad["thickness"], pad["poisson_ratio"], disc=3e-3)
    counts = np.rint(10 * stress * MODELS[model].areas).astype(int).clip(0, 255)
    recording = tn.load(recorded(tmp_path / "press.csv", counts), sensor="paxini", model=model, **pad)
    assert isinstance(recording, sensors.SensorRecording)
    carried = recording.tables().get("surface", {}).get("frames") == "carried"
    assert carried == any("is carried from the middle" in note for note in recording.notes)
    solution = recording.solve()
    assert solution.data[0] != "implausible", "where no modulus is given none is too soft"
    found, deviation = solution.normal_force[0], solution.normal_force_deviation[0]
    assert abs(found - 10.0) < 3.0 * deviation and found == pytest.approx(10.0, rel=0.25)
    assert deviation < 5.0
    shown = solution.to_point_set("isaac").values[0].sum(axis=0)
    assert np.linalg.norm(shown - force) < 0.25 * np.linalg.norm(force)
    if solution.surface is not None:
        above = points[at] + pad["thickness"] * normals[at]
        assert np.linalg.norm(solution.centre[0] - above) < 0.5 * pad["thickness"]


def test_most_models_need_frames_that_are_carried() -> None:
    """No direction keeps away from all normals of a fingertip: its frames are those of the middle, turned with the normal."""
    for model in ("PXSR-STDDP03C", "PXSR-STDIP03A"):
        geometry = MODELS[model]
        with pytest.raises(tn.InputError, match="within 10 degrees of the reference"):
            geometry.local_frames()
        frames = geometry.local_frames(frames="carried")
        assert np.abs(np.einsum("nij,nkj->nik", frames, frames) - np.eye(3)).max() < 1e-12
        assert np.abs(frames[:, 0] + geometry.normals).max() < 1e-15
        middle = geometry.normals.mean(axis=0) / np.linalg.norm(geometry.normals.mean(axis=0))
        axis = np.cross(middle, geometry.normals)
        e_y = np.array([0.0, 1.0, 0.0]) - middle[1] * middle
        assert np.abs(np.einsum("ni,ni->n", axis, frames[:, 1]) - axis @ e_y / np.linalg.norm(e_y)).max() < 1e-12


def test_init_writes_the_scene_of_what_is_saved(command: Any, tmp_path: Path) -> None:
    """`tactile-net init --sensor` and `SensorRecording.save` know the same taxels: one solves what the other wrote."""
    model = "PXSR-STDDP03A"
    recording = tn.load(recorded(tmp_path / "still.csv", np.zeros(135, dtype=int)), sensor="paxini", model=model, **PAD)
    assert isinstance(recording, sensors.SensorRecording)
    counts, _ = pressed(recording, 10.0)
    taken = tn.load(recorded(tmp_path / "press.csv", counts), sensor="paxini", model=model, **PAD)
    taken.save(tmp_path / "run")
    scene = tmp_path / "finger.toml"
    layer = ["--layer", str(1e3 * PAD["thickness"]), "--poisson", str(PAD["poisson_ratio"])]
    rms = 0.1 / 12**0.5 / float(np.median(taken.geometry.areas))
    command("init", "--sensor", "paxini", "--model", model, *layer, "--noise", repr(rms), "-o", str(scene))
    theirs = tn.Skin.load(scene)
    ours = taken.recording()
    again = theirs.read(tmp_path / "run/readings.csv")
    assert theirs.reading_names == ours.scene.reading_names
    assert np.allclose(again.readings, ours.readings, rtol=1e-12)
    assert np.allclose(theirs.solve(again).force, taken.solve().force, rtol=1e-9)

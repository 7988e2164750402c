"""Sensors by name: places and normals, frames in SI, what is asked for and what is refused, and forces at each taxel.

Files that a sensor's own package writes are in test_sensor_files.py."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import hypothesis
import numpy as np
import pytest
from conftest import PROJECT
from hypothesis import strategies as st
from numpy.typing import NDArray

import tactile_net as tn
from tactile_net import sensors

CURVED = PROJECT / "scenes/recorded/curved-pad"
PAD: dict[str, Any] = {"thickness": 4e-3, "youngs_modulus": 0.25e6, "poisson_ratio": 0.48}
DISPLACEMENTS = ["displacement_x", "displacement_y", "displacement_z"]
Array = NDArray[np.float64]


def sphere(radius: float, half_angle: float = 0.4, count: int = 10) -> tuple[Array, Array]:
    """Places on a ball about its pole, which is along z, and its normals; below 0: in a hole."""
    angle = np.linspace(-half_angle, half_angle, count)
    ray = np.array([[np.tan(a), np.tan(b), 1.0] for a in angle for b in angle])
    ray /= np.linalg.norm(ray, axis=1, keepdims=True)
    return ray * radius, ray * np.sign(radius)


def turned(seed: int) -> Array:
    """A rotation, its rows the axes x, e_y, e_z of a flat pad in a sensor's frame."""
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return np.asarray(q * np.sign(np.linalg.det(q)))


def pressed(skin: tn.Skin, reads: list[str]) -> tuple[tn.Skin, tn.Recording, Array]:
    """The skin on a layer with other readings, what it reads, and the places of its taxels along x, y and z."""
    on_layer = skin.replace(
        {
            "material.layer": {"thickness": 4e-3, "base": "bonded"},
            "sensor.reads": reads,
            "noise": None,
            "reconstruct": None,
        }
    )
    recording = on_layer.simulate()
    return on_layer, recording, np.column_stack([np.full(on_layer.count, 2e-3), on_layer.taxels])


def sensor_recording(geometry: tn.Geometry, frames: tn.Frames, **pad: Any) -> sensors.SensorRecording:
    return sensors.SensorRecording("points", "run", geometry, frames, sensors.Pad(**(PAD | pad)))


# Geometry.


@pytest.mark.parametrize("radius", [0.03, -0.03, 0.012])
def test_normals_of_a_ball_are_found(radius: float) -> None:
    """Within half a degree, and to the outer side, of a ball and of a hole."""
    places, normals = sphere(radius)
    geometry = tn.Geometry(places + [1e-3, -2e-3, 5e-3])
    cosines = np.einsum("ij,ij->i", geometry.normals, places / np.linalg.norm(places, axis=1, keepdims=True))
    assert np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))).max() < 0.5, "a surface bulges to its outer side"
    assert not geometry.flat
    assert "12 neighbours" in geometry.notes[0] and "bulges" in geometry.notes[0]


def test_a_side_that_is_named_is_taken() -> None:
    places, normals = sphere(0.03)
    inner = tn.Geometry(places, outward=[0.0, 0.0, -1.0])
    assert (np.einsum("ij,ij->i", inner.normals, normals) < -0.99).all()


@hypothesis.given(st.integers(0, 2**32 - 1))
def test_normals_turn_with_the_sensor(seed: int) -> None:
    """Rotated and shifted copies have rotated normals, the same areas and the same residual."""
    rng = np.random.default_rng(seed)
    places, _ = sphere(0.02)
    places = places + rng.normal(scale=5e-5, size=places.shape)
    turn, shift = turned(seed), rng.normal(scale=0.02, size=3)
    first, second = tn.Geometry(places), tn.Geometry(places @ turn.T + shift)
    assert np.allclose(first.normals @ turn.T, second.normals, atol=1e-9)
    assert np.allclose(first.areas, second.areas, rtol=1e-9)
    assert first.notes == second.notes


def test_a_plane_is_exact() -> None:
    grid = np.stack(np.meshgrid(np.arange(6) * 2e-3, np.arange(5) * 1.5e-3, indexing="ij"), -1).reshape(-1, 2)
    turn = turned(3)
    geometry = tn.Geometry(np.column_stack([np.zeros(30), grid]) @ turn)
    assert geometry.flat
    assert np.allclose(np.abs(geometry.normals @ turn[0]), 1.0, atol=1e-12)
    assert np.allclose(geometry.areas, 3e-6, rtol=1e-9), "those at the rim too"
    assert "nearly flat" in geometry.notes[0]


def test_areas_of_a_ball_add_up() -> None:
    """Fibonacci's points over a whole ball: within 2 % of 4 pi r^2."""
    k = np.arange(800) + 0.5
    polar, around = np.arccos(1 - 2 * k / 800), np.pi * (1 + 5**0.5) * k
    normals = np.stack([np.cos(around) * np.sin(polar), np.sin(around) * np.sin(polar), np.cos(polar)], axis=1)
    geometry = tn.Geometry(0.02 * normals, normals)
    assert geometry.areas.sum() == pytest.approx(4 * np.pi * 0.02**2, rel=0.02)


def test_local_frames_are_right_handed_and_tangent() -> None:
    places, normals = sphere(0.02)
    frames = tn.Geometry(places, normals).local_frames()
    assert np.allclose(frames @ frames.transpose(0, 2, 1), np.eye(3), atol=1e-12)
    assert np.allclose(np.linalg.det(frames), 1.0)
    assert np.allclose(frames[:, 0], -normals)
    assert (frames[:, 1] @ [0.0, 1.0, 0.0] > 0.9).all()
    with pytest.raises(tn.InputError, match="within 10 degrees of the reference direction at t"):
        tn.Geometry(places, normals).local_frames([0.0, 0.0, 1.0])


def test_a_geometry_comes_back_from_its_file(tmp_path: Path) -> None:
    places, normals = sphere(0.02)
    geometry = tn.Geometry(places, normals, 1.2e-3, DISPLACEMENTS, [f"p{k}" for k in range(100)])
    geometry.save(tmp_path / "finger.csv")
    again = tn.Geometry.load(tmp_path / "finger.csv")
    assert np.array_equal(again.positions, geometry.positions)
    assert np.allclose(again.normals, geometry.normals, rtol=0, atol=1e-15)
    assert again.depth is not None and np.array_equal(again.depth, np.full(100, 1.2e-3))
    assert again.names == geometry.names and again.reads == tuple(DISPLACEMENTS)
    header = (tmp_path / "finger.csv").read_text().splitlines()[0]
    assert header == "name,x,y,z,nx,ny,nz,depth,reads"


def test_units_of_a_file_are_those_of_its_header_or_given(tmp_path: Path) -> None:
    text = "name,x [mm],y [mm],z [mm]\n" + "".join(f"a{k},{k % 4},{k // 4},{0.01 * k * k}\n" for k in range(12))
    (tmp_path / "a.csv").write_text(text)
    (tmp_path / "b.csv").write_text(text.replace(" [mm]", ""))
    stated = tn.Geometry.load(tmp_path / "a.csv")
    assert np.allclose(stated.positions[5], [1e-3, 1e-3, 0.25e-3])
    assert np.array_equal(tn.Geometry.load(tmp_path / "b.csv", unit="mm").positions, stated.positions)
    with pytest.raises(tn.InputError, match=r"taxels over 3 m: from 1 mm to 1 m[\s\S]*are these millimetres"):
        tn.Geometry.load(tmp_path / "b.csv")
    with pytest.raises(tn.InputError, match="lengths in cm, mm"):
        tn.Geometry.load(tmp_path / "a.csv", unit="cm")


@pytest.mark.parametrize(
    "text, said",
    [
        ("name,x,y\na,0,0\n", "x, y and z are needed"),
        ("x,y,z,colour\n0,0,0,red\n", "a column 'colour'"),
        ("x,y,z\n0,0\n", "2 fields in row 1"),
        ("x,y,z\n0,0,zero\n", "'zero' in the column z, row 1"),
        ("x,y,z,nx\n0,0,0,1\n", "one or two of nx, ny and nz"),
        ("x,y,z\n", "no row below its header"),
        ("", "is empty"),
        ("x,x,z\n0,0,0\n", "the column 'x' twice"),
        ("x,y,z\n0,0,0\n0.01,0,0\n", "2 taxels: from 3"),
        ("x,y,z\n0,0,0\n0.01,0,0\n0.01,0,0\n", "taxels 1 and 2 at one place"),
        ("x,y,z\n0,0,0\n0.01,0,0\n0.02,0,0\n0.03,0,0\n", "all its taxels on a line"),
        ("x,y,z,nx,ny,nz\n0,0,0,0,0,2\n0.01,0,0,0,0,1\n0,0.01,0,0,0,1\n", "a normal of length 2 at t0"),
        ("x,y,z,depth\n0,0,0,1e-3\n0.01,0,0,0\n0,0.01,0,1e-3\n", "a depth that is not above 0"),
        ("name,x,y,z\na,0,0,0\na,0.01,0,0\nb,0,0.01,0\n", "3 taxels and 2 names"),
        ("x,y,z,reads\n0,0,0,force_x\n0.01,0,0,force_y\n0,0.01,0,force_x\n", "read different quantities"),
        ("x [parsec],y [parsec],z [parsec]\n0,0,0\n1,0,0\n0,1,0\n", "'parsec': units of length that are known"),
        ("x,y,z\n0,0,nan\n0.01,0,0\n0,0.01,0\n", "that are not finite at taxel 0"),
    ],
)
def test_bad_files_of_taxels_are_refused(text: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "finger.csv"
    file.write_text(text)
    with pytest.raises(tn.InputError) as caught:
        tn.Geometry.load(file)
    assert said in str(caught.value) and str(caught.value).startswith(f"{file}: error: ")


def test_a_file_of_bytes_is_no_table(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(b"\xff\xfe\x00x,y\n")
    with pytest.raises(tn.InputError, match="is no CSV"):
        tn.Geometry.load(tmp_path / "a.csv")


# Frames.


def test_frames_are_judged() -> None:
    values = np.zeros((3, 4, 3))
    assert len(tn.Frames(values)) == 3
    frames = tn.Frames(values, np.array([0.0, 0.1, 0.5]), "m")
    assert np.array_equal(frames.t if frames.t is not None else [], [0.0, 0.1, 0.5]), "nothing is interpolated"
    assert "gap" in frames.notes[0]
    for wrong, said in (
        ({"readings": np.zeros((3, 4))}, "not \\(frames, taxels, channels\\)"),
        ({"readings": np.full((1, 2, 3), np.inf)}, "infinite"),
        ({"units": "furlong"}, "'furlong'"),
        ({"frame": "world"}, "'world'"),
        ({"t": np.array([0.0, 2.0, 1.0])}, "goes back in time"),
        ({"t": np.array([0.0, 2.0])}, "times of the shape"),
    ):
        with pytest.raises(tn.InputError, match=said):
            tn.Frames(**({"readings": values} | wrong))


# Forces.


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_flat_sensor_in_any_position_is_the_skin(skin: tn.Skin, seed: int) -> None:
    """Places and displacements in a sensor's frame that is turned: the same forces, turned; their sum is the resultant."""
    scene, recording, places = pressed(skin, DISPLACEMENTS)
    turn = turned(seed)
    geometry = tn.Geometry(places @ turn, np.broadcast_to(-turn[0], places.shape), 2e-3)
    readings = recording.readings.reshape(1, -1, 3) @ turn
    reference = tuple(turn[1] + 0.3 * turn[0])
    taken = sensor_recording(geometry, tn.Frames(readings, None, "m"), reference=reference)
    solution = taken.solve()
    assert np.allclose(taken.recording().readings.reshape(3, -1).T, (readings @ turn.T)[0], atol=1e-18)
    points = solution.to_point_set("lerobot")
    assert points.values.shape == points.sigma.shape == (1, scene.count, 6)
    assert points.columns == ("dx", "dy", "dz", "Fx", "Fy", "Fz")
    assert np.array_equal(points.values[..., :3], readings)
    resultant = solution.wrench[:, :3] @ turn
    assert np.abs(points.values[..., 3:].sum(axis=1) - resultant).max() <= 1e-12 * np.abs(resultant).max()
    assert solution.normal_force[0] == pytest.approx(0.5, rel=0.15)
    assert (points.sigma[..., 3:] >= 0.0).all() and points.sigma[..., 3:].max() > 0.0
    newtons = solution.to_point_set("isaac")
    assert newtons.values.shape == (1, scene.count, 3)
    assert np.array_equal(newtons.values, points.values[..., 3:])


def test_point_forces_lie_where_the_contact_is(skin: tn.Skin) -> None:
    """The force of the taxels about their middle is the moment of the cells: the centre within half a pitch."""
    _, recording, places = pressed(skin, DISPLACEMENTS)
    turn = turned(7)
    geometry = tn.Geometry(places @ turn, np.broadcast_to(-turn[0], places.shape), 2e-3)
    taken = sensor_recording(
        geometry, tn.Frames(recording.readings.reshape(1, -1, 3) @ turn, None, "m"), reference=tuple(turn[1])
    )
    solution = taken.solve()
    forces = solution.to_point_set("isaac").values[0] @ turn.T
    centre = forces[:, 0] @ places[:, 1:] / forces[:, 0].sum()
    assert np.abs(centre - solution.centre[0]).max() < 0.8e-3


def test_forces_are_stresses_times_areas_and_need_no_modulus(skin: tn.Skin) -> None:
    scene, recording, places = pressed(skin, ["stress_x", "shear_xy", "shear_xz"])
    turn = turned(4)
    geometry = tn.Geometry(places @ turn, np.broadcast_to(-turn[0], places.shape), 2e-3)
    forces = 3e-6 * recording.readings.reshape(1, -1, 3) @ turn  # of taxels 2 x 1.5 mm apart
    found = [
        sensor_recording(geometry, tn.Frames(forces), youngs_modulus=modulus, reference=tuple(turn[1]))
        for modulus in (None, 1e4, 3e6)
    ]
    assert np.allclose(found[0].recording().readings.reshape(3, -1).T, recording.readings.reshape(-1, 3), rtol=1e-9)
    assert any("do not depend on it" in note for note in found[0].notes)
    answers = [one.solve().wrench for one in found]
    assert np.allclose(answers[0], answers[1], rtol=1e-9, equal_nan=True)
    assert np.allclose(answers[0], answers[2], rtol=1e-9, equal_nan=True)
    assert answers[0][0, 0] == pytest.approx(0.5, rel=0.15)


def test_a_lerobot_point_set_comes_back(skin: tn.Skin, tmp_path: Path) -> None:
    """Written, read as forces and as displacements: the same numbers, and sums to 1e-12."""
    pytest.importorskip("pyarrow")
    _, recording, places = pressed(skin, DISPLACEMENTS)
    turn = turned(1)
    geometry = tn.Geometry(places @ turn, np.broadcast_to(-turn[0], places.shape), 2e-3)
    readings = np.concatenate([recording.readings, 0.5 * recording.readings]).reshape(2, -1, 3) @ turn
    frames = tn.Frames(readings, np.array([0.0, 0.04]), "m")
    points = sensor_recording(geometry, frames, reference=tuple(turn[1])).solve().to_point_set()
    points.save(tmp_path / "points.parquet")
    units = {"displacement": "m", "force": "N"}
    for kind, columns in (("displacement", slice(0, 3)), ("force", slice(3, 6))):
        again = tn.load(
            tmp_path / "points.parquet",
            sensor="lerobot",
            geometry=geometry,
            units=units,
            reads=kind,
            reference=turn[1],
            **PAD,
        )
        assert np.array_equal(again.frames.readings, points.values[..., columns])
        assert again.frames.t is not None and np.array_equal(again.frames.t, [0.0, 0.04])
    assert np.abs(again.frames.readings.sum(axis=1) - points.values[..., 3:].sum(axis=1)).max() <= 1e-12


def test_what_is_saved_is_what_the_command_solves(skin: tn.Skin, command: Any, tmp_path: Path) -> None:
    _, recording, places = pressed(skin, DISPLACEMENTS)
    geometry = tn.Geometry(places[:, [1, 2, 0]] * [1, 1, -1], np.broadcast_to([0.0, 0.0, 1.0], places.shape), 2e-3)
    readings = recording.readings.reshape(1, -1, 3)[..., [1, 2, 0]] * [1, 1, -1]
    taken = sensor_recording(geometry, tn.Frames(readings, None, "m"), reference=(1.0, 0.0, 0.0))
    taken.save(tmp_path / "run")
    scene, readings_file, told = (tmp_path / "run" / name for name in ("scene.toml", "readings.csv", "told.json"))
    command("solve", scene, "--readings", readings_file, "--json", told)
    found = json.loads(told.read_text())
    assert found["rows"][0]["resultant"]["normal"]["value"] == pytest.approx(taken.solve().normal_force[0], rel=1e-9)


def test_what_is_missing_is_asked_for(skin: tn.Skin, tmp_path: Path) -> None:
    _, recording, places = pressed(skin, DISPLACEMENTS)
    geometry = tn.Geometry(places, np.broadcast_to([-1.0, 0.0, 0.0], places.shape))
    file = tmp_path / "finger.csv"
    sensors.adapter("points").write(file, geometry, tn.Frames(recording.readings.reshape(1, -1, 3), None, "m"))  # type: ignore[attr-defined]
    for given, missing in (
        ({}, "thickness, youngs_modulus, poisson_ratio missing"),
        ({"thickness": 4e-3}, "youngs_modulus, poisson_ratio missing"),
        ({"thickness": 4e-3, "poisson_ratio": 0.48}, "say nothing of forces without a modulus"),
    ):
        with pytest.raises(tn.InputError, match=missing):
            tn.load(file, sensor="points", **given)  # type: ignore[arg-type]
    taken = tn.load(file, sensor="points", **PAD)
    assert any("0.15 of the thickness" in note for note in taken.notes), "a depth that nobody said is told"
    assert taken.scene().to_dict()["units"] == {}
    deep = tn.load(file, sensor="points", depth=1e-3, noise=2e-7, **PAD)
    assert np.allclose(deep.scene().sites.depth, 1e-3)
    assert deep.scene().to_dict()["noise"]["rms"] == dict.fromkeys(DISPLACEMENTS, 2e-7)
    with pytest.raises(tn.InputError, match="30 taxels, and the geometry has 3"):
        tn.load(file, sensor="points", geometry=tn.Geometry(places[[0, 1, 7]]), **PAD)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"thickness": -3e-3}, r"a pad of thickness=-0.003[\s\S]*in metres"),
        ({"thickness": 3.0}, r"a pad of thickness=3.0[\s\S]*in metres"),
        ({"thickness": float("nan")}, "a pad of thickness=nan"),
        ({"thickness": "3 mm"}, "a pad of thickness='3 mm'"),
        ({"poisson_ratio": 0.7}, "a pad of poisson_ratio=0.7"),
        ({"youngs_modulus": 0.0}, "a pad of youngs_modulus=0.0"),
        ({"depth": 5e-3}, r"at depth=0.005 in a pad of thickness=0.004"),
        ({"noise": -1.0}, "a pad of noise=-1.0"),
        ({"reference": (0.0, 0.0, 0.0)}, r"along reference=\(0.0, 0.0, 0.0\)"),
        ({"reference": (0.0, 1.0)}, r"along reference=\(0.0, 1.0\)"),
        ({"base": "frictionless"}, r"base='frictionless'[\s\S]*of a curved pad"),
    ],
)
def test_what_no_pad_has_is_refused_by_its_name(given: dict[str, Any], said: str) -> None:
    places, normals = sphere(20e-3)
    frames = tn.Frames(np.zeros((1, len(places), 3)), None, "m", file="run")
    with pytest.raises(tn.InputError, match=rf"^run: error: cannot have .*{said}"):
        sensors.SensorRecording("points", "run", tn.Geometry(places, normals), frames, sensors.Pad(**(PAD | given)))


def test_one_channel_says_that_it_tells_of_no_drag() -> None:
    places, normals = sphere(20e-3)
    for channels, told in ((1, True), (3, False)):
        frames = tn.Frames(np.zeros((1, len(places), channels)), None, "N", "local")
        notes = sensors.SensorRecording("points", "run", tn.Geometry(places, normals), frames, sensors.Pad(**PAD)).notes
        assert any("tells of no drag" in one for one in notes) == told


def test_a_file_that_is_not_there_is_said_to_be_none(tmp_path: Path) -> None:
    for name in ("paxini", "lerobot", "tac3d"):
        with pytest.raises(FileNotFoundError, match="none.csv"):
            tn.load(tmp_path / "none.csv", sensor=name, **PAD)


def test_readings_that_are_missing_are_estimated(skin: tn.Skin) -> None:
    _, recording, places = pressed(skin, DISPLACEMENTS)
    geometry = tn.Geometry(places, np.broadcast_to([-1.0, 0.0, 0.0], places.shape), 2e-3)
    readings = np.repeat(recording.readings.reshape(1, -1, 3), 2, axis=0)
    whole = sensor_recording(geometry, tn.Frames(readings, None, "m")).solve()
    readings[1, 3, 1] = np.nan
    part = sensor_recording(geometry, tn.Frames(readings, None, "m")).solve()
    assert part.normal_force[1] == pytest.approx(whole.normal_force[1], rel=0.02)


def test_point_sets_are_of_sensors(skin: tn.Skin) -> None:
    with pytest.raises(ValueError, match="of a sensor's recording"):
        skin.simulate().solve().to_point_set()  # type: ignore[attr-defined]


# By name.


def test_names_are_the_modules() -> None:
    folder = Path(sensors.__file__).parent
    assert sensors.names() == tuple(sorted(one.stem for one in folder.glob("[a-z]*.py")))
    assert len(sensors.names()) == 12
    for name in sensors.names():
        one = sensors.adapter(name)
        assert one.name == name and one.sniff("/nowhere/at all") == 0.0
        assert len((folder / f"{name}.py").read_text().splitlines()) <= 150
    with pytest.raises(ValueError, match="no sensor 'gelsight': known are anyskin, biotac"):
        tn.load("x", sensor="gelsight", **PAD)


@pytest.mark.parametrize("name", ["anyskin", "biotac", "mjlab", "mujoco"])
def test_what_has_no_elastic_model_is_refused_with_the_reason(name: str, tmp_path: Path) -> None:
    reason = sensors.refusal(name)
    assert len(reason) > 80
    with pytest.raises(tn.InputError) as caught:
        tn.load(tmp_path, sensor=name, **PAD)
    assert reason in str(caught.value) and "tn.sensors.frames" in str(caught.value)
    assert all(
        sensors.refusal(one) == "" for one in sensors.names() if one not in ("anyskin", "biotac", "mjlab", "mujoco")
    )


def test_two_that_it_looks_like_are_refused(tmp_path: Path) -> None:
    np.savez(
        tmp_path / "both.npz", depth=np.zeros((1, 2, 2)), slip=np.zeros((1, 2, 2, 2)), normal_forces=np.zeros((1, 4))
    )
    assert set(sensors.sniffed(tmp_path / "both.npz")) == {"mjlab", "dex01"}
    with pytest.raises(tn.InputError, match=r"several sensors: [\s\S]*sensor= one of them"):
        tn.load(tmp_path / "both.npz", **PAD)
    (tmp_path / "none.csv").write_text("a,b\n1,2\n")
    with pytest.raises(tn.InputError, match=r"no sensor that is known[\s\S]*sensor= one of anyskin, biotac"):
        tn.load(tmp_path / "none.csv", **PAD)


def test_a_file_that_looks_like_a_sensors_is_named(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text("Timestamp,1-2-NxN-X[0],1-2-NxN-Y[0],1-2-NxN-Z[0]\n00:00:00.000,0,0,1\n")
    with pytest.raises(tn.InputError, match=r'give scene=, or sensor="paxini", whose file it looks like'):
        tn.load(tmp_path / "run.csv")


def test_a_sensors_words_are_no_recordings(tmp_path: Path, scene: tn.Scene) -> None:
    with pytest.raises(TypeError, match="scene= and missing= are of recordings"):
        tn.load(tmp_path, sensor="tac3d", scene=scene)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="thicknes"):
        tn.load(tmp_path, thicknes=4e-3)  # type: ignore[call-overload]


HOSTILE = """
import numpy, sys
class Boom:
    def __reduce__(self):
        return (open, (sys.argv[1] + ".ran", "w"))
numpy.save(sys.argv[1], numpy.array([Boom()]), allow_pickle=True)
names = "depth", "slip", "normal_forces", "sensordata"
numpy.savez(sys.argv[1] + ".npz", **{name: numpy.array([Boom()]) for name in names})
"""


def test_no_pickle_is_loaded(tmp_path: Path) -> None:
    file = tmp_path / "3D_Displacements.npy"
    subprocess.run([sys.executable, "-c", HOSTILE, str(file)], check=True)
    (tmp_path / "3D_Positions.npy").write_bytes(file.read_bytes())
    for read in (
        lambda: tn.load(tmp_path, sensor="tac3d", **PAD),
        lambda: sensors.frames(file, "anyskin"),
        lambda: sensors.frames(f"{file}.npz", "mjlab"),
        lambda: sensors.frames(f"{file}.npz", "dex01"),
        lambda: sensors.frames(f"{file}.npz", "mujoco"),
    ):
        with pytest.raises(tn.InputError, match="Python objects, which can run anything"):
            read()
    assert not list(tmp_path.glob("*.ran"))


@pytest.mark.parametrize("name", sensors.names())
def test_a_strange_file_is_refused_by_name(name: str, tmp_path: Path) -> None:
    """Of every adapter: bytes, an empty file, text, JSON, an archive, and what is cut off; never another error."""
    np.savez(tmp_path / "archive", a=np.zeros(3))
    whole = (tmp_path / "archive.npz").read_bytes()
    contents = [
        b"",
        b"\x00\xff" * 999,
        b"hello, world\n1\n",
        b'{"1": {"data": "zz"}}\n',
        whole,
        whole[:60],
        b"\x93NUMPY\x01\x00",
    ]
    contents += [
        b"PAR1" + bytes(40),
        b"\x89MCAP0\r\n" + bytes(99),
        b"x,y\n" + b"1,2\n" * 5,
        b"[" * 100_000,
        b"{}\n\n{}\n",
    ]
    file = tmp_path / "strange"
    for content in contents:
        file.write_bytes(content)
        assert sensors.sniffed(file).get(name, 0.0) <= 0.9
        with pytest.raises((tn.InputError, ImportError)) as caught:
            sensors.frames(file, name, units="N", gain=1.0, frame="sensor", pitch=1e-3)
        assert isinstance(caught.value, ImportError) or str(file) in str(caught.value)


# The curved pad of finite elements, as soon as the library solves curved skins.


def curved() -> sensors.SensorRecording:
    units = {"displacement": "mm", "length": "mm"}
    return tn.load(CURVED / "cap.csv", sensor="points", frame="sensor", units=units, noise=1e-6, **PAD)


def test_the_public_cap_is_read() -> None:
    taken = curved()
    assert repr(taken) == "<SensorRecording of points: 8 frames of 100 taxels in m>"
    assert np.allclose(np.linalg.norm(taken.geometry.positions, axis=1), 28.8e-3, atol=1e-8)
    assert taken.geometry.depth is not None and np.allclose(taken.geometry.depth, 1.2e-3)
    fitted = tn.Geometry(taken.geometry.positions)
    assert np.einsum("ij,ij->i", fitted.normals, taken.geometry.normals).min() > np.cos(np.radians(0.2))
    tables = taken.tables()
    assert tables["sensor"] == {"taxels": "taxels.csv", "frame": "sensor"} and "surface" in tables


def test_the_public_cap_is_solved() -> None:
    """The answer of the scene beside it; forces of frames 1 to 6 within 6 % of the truth, and a share at each taxel."""
    truth = json.loads((CURVED / "cap.truth.json").read_text())["frames"]
    solution = curved().solve()
    points = solution.to_point_set("isaac")
    for k in range(1, 7):
        force = np.array(truth[k]["force"])
        assert np.linalg.norm(solution.force[k] - force) < 0.06 * np.linalg.norm(force), k
    scene = tn.Scene.load(CURVED / "cap.toml")
    same = scene.solve(scene.read(CURVED / "cap.csv"))
    assert isinstance(same, tn.SkinSolution) and np.allclose(solution.force, same.force, rtol=1e-6, atol=1e-9)
    resultant = np.linalg.norm(solution.force, axis=1)
    assert (np.abs(points.values.sum(axis=1) - solution.force).max(axis=1) <= 1e-12 * np.maximum(resultant, 1.0)).all()
    press = points.values[1]
    heaviest = curved().geometry.positions[np.argmax(np.linalg.norm(press, axis=1))]
    assert np.linalg.norm(heaviest - np.array(truth[1]["centre"])) < 3e-3


def test_a_turned_sensor_finds_turned_forces() -> None:
    """The cap, its places and its readings turned and shifted: the forces at each taxel turn with it."""
    cap, turn = curved(), turned(5)
    frames = cap.frames.readings[[1, 5]]
    there = cap.geometry.replace(
        positions=cap.geometry.positions @ turn.T + [0.01, 0.02, -0.03], normals=cap.geometry.normals @ turn.T
    )
    reference = (0.0, 1.0, 0.0)
    first = sensor_recording(cap.geometry, tn.Frames(frames, units="m"), noise=1e-6, reference=reference).solve()
    second = sensor_recording(
        there, tn.Frames(frames @ turn.T, units="m"), noise=1e-6, reference=tuple(turn @ reference)
    ).solve()
    before, after = (one.to_point_set("isaac").values for one in (first, second))
    assert np.abs(before @ turn.T - after).max() < 1e-8 * np.abs(before).max()


def test_a_curved_scene_in_millimetres_takes_a_csv() -> None:
    """As `Skin.read` does: the file of taxels keeps its unit."""
    skin = tn.Skin.load(CURVED / "cap.toml")
    taken = tn.load(CURVED / "cap.csv", scene=skin)
    assert np.array_equal(taken.readings, skin.read(CURVED / "cap.csv").readings)


def test_a_reference_is_chosen_where_y_is_too_near_a_normal() -> None:
    """A cylinder's end cap, whose normals lead along y: x is followed, and a note says so."""
    places, normals = sphere(0.03)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]).T  # z to y
    facing_y = tn.Geometry(places @ turn, normals @ turn, 2e-3, ["stress_x"])
    still = tn.Frames(np.zeros((1, 100, 1)), units="Pa", frame="local")
    taken = sensor_recording(facing_y, still)
    reference = taken.tables()["surface"]["reference"]
    assert np.abs(facing_y.normals @ reference).max() < np.cos(np.radians(10.0))
    assert any("e_y follows" in note and "reference=" in note for note in taken.notes)
    kept = sensor_recording(tn.Geometry(places, normals, 2e-3, ["stress_x"]), still)
    assert kept.tables()["surface"]["reference"] == [0.0, 1.0, 0.0]
    assert not any("e_y follows" in note for note in kept.notes)
    stated = sensor_recording(facing_y, still, reference=(0.0, 1.0, 0.0))
    with pytest.raises(tn.InputError, match="within 10 degrees"):
        stated.solve()

"""Files that sensors' own packages write, read by name: of each adapter one, and of each what is wrong with it.

A package that is absent skips its tests: tools/python optional has them, but for lerobot, which takes gigabytes. PaXini's and
Tac3D's have files of their own."""

from __future__ import annotations

import csv
import io
import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from sensor_pads import PAD, SOFT, bump, flat_grid, lattice_skin

import tactile_net as tn
from tactile_net import sensors
from tactile_net._containers import read_npz
from tactile_net.sensors._reading import array_in, arrays_in

RNG = np.random.default_rng(42)

# LeRobot.


def parquet(path: Path, values: NDArray[Any], names: str = "", **more: Any) -> None:
    arrow, write = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    column = arrow.array(values.tolist(), type=arrow.list_(arrow.list_(arrow.float32())))
    metadata = {b"names": names.encode()} if names else None
    fields = [arrow.field("observation.tactile", column.type, metadata=metadata)]
    columns = [column]
    for name, numbers in more.items():
        columns.append(arrow.array(numbers))
        fields.append(arrow.field(name, columns[-1].type))
    write.write_table(arrow.table(columns, schema=arrow.schema(fields)), path)


def test_lerobots_parquet(tmp_path: Path) -> None:
    geometry = flat_grid(5, 4)
    values = RNG.normal(scale=1e-2, size=(7, 20, 6)).astype(np.float32)
    path = tmp_path / "a.parquet"
    parquet(path, values, timestamp=np.arange(7) / 30)
    assert list(sensors.sniffed(path)) == ["lerobot"]
    with pytest.raises(tn.InputError, match="has no places of its points"):
        tn.load(path, sensor="lerobot", **SOFT)
    with pytest.raises(tn.InputError, match="not say in which unit its displacements are"):
        tn.load(path, sensor="lerobot", geometry=geometry, **SOFT)
    units = {"displacement": "mm", "force": "N"}
    taken = tn.load(path, geometry=geometry, units=units, **SOFT)
    assert np.allclose(taken.frames.readings, 1e-3 * values[..., :3], rtol=1e-12) and taken.frames.units == "m"
    assert taken.frames.t is not None and np.allclose(taken.frames.t, np.arange(7) / 30)
    forces = tn.load(path, geometry=geometry, units=units, reads="force", **PAD)
    assert np.allclose(forces.frames.readings, values[..., 3:], rtol=1e-12) and forces.frames.units == "N"
    parquet(path, values[..., :3])
    with pytest.raises(tn.InputError, match=r'says not of what[\s\S]*reads="displacement"'):
        tn.load(path, sensor="lerobot", geometry=geometry, units=units, **SOFT)
    parquet(path, values[..., :3], "Fx Fy Fz")
    assert tn.load(path, geometry=geometry, units=units, **PAD).frames.units == "N"
    parquet(path, values[:, :1], "Fx Fy Fz Tx Ty Tz")
    with pytest.raises(tn.InputError, match="is a wrench"):
        tn.load(path, sensor="lerobot", geometry=geometry, units=units, **PAD)
    parquet(path, values[..., :2])
    with pytest.raises(tn.InputError, match="2 numbers a point, and 3 or 6 are known"):
        tn.load(path, sensor="lerobot", geometry=geometry, units=units, **PAD)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(tn.InputError, match="is not a whole Parquet"):
        tn.load(path, sensor="lerobot", geometry=geometry, units=units, **PAD)


def test_lerobot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A data set of two episodes that lerobot itself writes."""
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    pytest.importorskip("lerobot", reason="lerobot is not installed: it takes gigabytes")
    dataset = pytest.importorskip("lerobot.datasets.lerobot_dataset")
    feature = {"dtype": "float32", "shape": (20, 6), "names": ["dx", "dy", "dz", "Fx", "Fy", "Fz"]}
    made = dataset.LeRobotDataset.create(
        "a/b", 30, root=tmp_path / "set", features={"observation.tactile.finger": feature}, use_videos=False
    )
    values = RNG.normal(size=(2, 4, 20, 6)).astype(np.float32)
    for episode in values:
        for frame in episode:
            made.add_frame({"observation.tactile.finger": frame, "task": "press"})
        made.save_episode()
    made.finalize()
    assert list(sensors.sniffed(tmp_path / "set")) == ["lerobot"]
    given = {"geometry": flat_grid(5, 4), "units": {"displacement": "mm", "force": "N"}} | SOFT
    with pytest.raises(tn.InputError, match=r"has 2 episodes: 0, 1"):
        tn.load(tmp_path / "set", sensor="lerobot", **given)
    taken = tn.load(tmp_path / "set", sensor="lerobot", name="observation.tactile.finger@1", **given)
    assert np.allclose(taken.frames.readings, 1e-3 * values[1, ..., :3], rtol=1e-6)
    assert taken.frames.t is not None and np.allclose(taken.frames.t, np.arange(4) / 30, atol=1e-6)


# Isaac: FlatBuffers with their schema in MCAP.


Schema = dict[str, tuple[bool, int, list[tuple[str, int, int, int, int]]]]


def vector_of(builder: Any, offsets: list[int]) -> int:
    builder.StartVector(4, len(offsets), 4)
    for one in reversed(offsets):
        builder.PrependUOffsetTRelative(one)
    return int(builder.EndVector())


def type_of(builder: Any, base: int, element: int, index: int) -> int:
    builder.StartObject(6)
    builder.PrependInt8Slot(0, base, 0)
    builder.PrependInt8Slot(1, element, 0)
    builder.PrependInt32Slot(2, index, -1)
    return int(builder.EndObject())


def flatbuffers_schema(tables: Schema, root: str, union: int | None = None) -> bytes:
    """A .bfbs, as flatc lays it out: tables and structs by name; fields (name, type, element, index of the table in the order
    of names, offset); union: the table that the only union may be."""
    builder = pytest.importorskip("flatbuffers", reason="flatbuffers is not installed").Builder(1024)
    order = sorted(tables)
    objects = []
    for name in order:
        is_struct, size, fields = tables[name]
        offsets = []
        for field_id, (field, kind, element, index, offset) in enumerate(fields):
            text, of = builder.CreateString(field), type_of(builder, kind, element, index)
            builder.StartObject(14)
            builder.PrependUOffsetTRelativeSlot(0, text, 0)
            builder.PrependUOffsetTRelativeSlot(1, of, 0)
            builder.PrependUint16Slot(2, field_id, 0)
            builder.PrependUint16Slot(3, offset, 0)
            offsets.append(builder.EndObject())
        listed, text = vector_of(builder, offsets), builder.CreateString(name)
        builder.StartObject(8)
        builder.PrependUOffsetTRelativeSlot(0, text, 0)
        builder.PrependUOffsetTRelativeSlot(1, listed, 0)
        builder.PrependBoolSlot(2, is_struct, False)
        builder.PrependInt32Slot(3, 4, 0)
        builder.PrependInt32Slot(4, size, 0)
        objects.append(builder.EndObject())
    unions = []
    if union is not None:
        values = []
        for value, index in ((0, -1), (1, union)):
            of = type_of(builder, TABLE if index >= 0 else 0, 0, index)
            builder.StartObject(6)
            builder.PrependInt64Slot(1, value, 0)
            builder.PrependUOffsetTRelativeSlot(3, of, 0)
            values.append(builder.EndObject())
        listed = vector_of(builder, values)
        builder.StartObject(7)
        builder.PrependUOffsetTRelativeSlot(1, listed, 0)
        builder.PrependBoolSlot(2, True, False)
        unions.append(builder.EndObject())
    listed, enums = vector_of(builder, objects), vector_of(builder, unions)
    builder.StartObject(8)
    builder.PrependUOffsetTRelativeSlot(0, listed, 0)
    builder.PrependUOffsetTRelativeSlot(1, enums, 0)
    builder.PrependUOffsetTRelativeSlot(4, objects[order.index(root)], 0)
    builder.Finish(builder.EndObject(), file_identifier=b"BFBS")
    return bytes(builder.Output())


FLOAT, VECTOR, TABLE, UNION, TAG, LONG = 11, 14, 15, 16, 1, 9
POINT = (True, 12, [("x", FLOAT, 0, -1, 0), ("y", FLOAT, 0, -1, 4), ("z", FLOAT, 0, -1, 8)])
ROTATION = (True, 16, [(axis, FLOAT, 0, -1, 4 * k) for k, axis in enumerate("xyzw")])


def forces_schema() -> bytes:
    tables: Schema = {
        "core.DeviceDataTimestamp": (True, 16, [("device_time", LONG, 0, -1, 0), ("common_time", LONG, 0, -1, 8)]),
        "core.Point": POINT,
        "core.TactileDataArray": (False, 0, [("forces", VECTOR, TABLE, 1, 4)]),
        "core.TactileDataArrayRecord": (False, 0, [("data", TABLE, 0, 2, 4), ("timestamp", TABLE, 0, 0, 6)]),
    }
    return flatbuffers_schema(tables, "core.TactileDataArrayRecord")


def layout_schema() -> bytes:
    """The layout is a union in it."""
    poses = [("segment_bind_poses", VECTOR, TABLE, 2, 4), ("taxel_bind_poses", VECTOR, TABLE, 2, 6)]
    tables: Schema = {
        "core.LBS": (False, 0, poses),
        "core.Point": POINT,
        "core.Pose": (True, 28, [("position", TABLE, 0, 1, 0), ("orientation", TABLE, 0, 3, 12)]),
        "core.Quaternion": ROTATION,
        "core.TactileMetadata": (False, 0, [("mapping_type", TAG, 0, 0, 4), ("mapping", UNION, 0, 0, 6)]),
    }
    return flatbuffers_schema(tables, "core.TactileMetadata", union=0)


def struct_vector(builder: Any, rows: NDArray[Any]) -> int:
    builder.StartVector(4 * rows.shape[1], len(rows), 4)
    for one in reversed(rows.tolist()):
        for number in reversed(one):
            builder.PrependFloat32(number)
    return int(builder.EndVector())


def record(rows: NDArray[Any]) -> bytes:
    builder = pytest.importorskip("flatbuffers").Builder(64)
    forces = struct_vector(builder, rows)
    builder.StartObject(1)
    builder.PrependUOffsetTRelativeSlot(0, forces, 0)
    data = builder.EndObject()
    builder.StartObject(2)
    builder.PrependUOffsetTRelativeSlot(0, data, 0)
    builder.Finish(builder.EndObject())
    return bytes(builder.Output())


def layout(places: NDArray[Any]) -> bytes:
    builder = pytest.importorskip("flatbuffers").Builder(64)
    poses = np.column_stack([places, np.tile([0.0, 0.0, 0.0, 1.0], (len(places), 1))])
    joints, taxels = struct_vector(builder, poses[:4]), struct_vector(builder, poses)
    builder.StartObject(2)
    builder.PrependUOffsetTRelativeSlot(0, joints, 0)
    builder.PrependUOffsetTRelativeSlot(1, taxels, 0)
    mapping = builder.EndObject()
    builder.StartObject(2)
    builder.PrependUint8Slot(0, 1, 0)
    builder.PrependUOffsetTRelativeSlot(1, mapping, 0)
    builder.Finish(builder.EndObject())
    return bytes(builder.Output())


def isaac_log(path: Path, forces: NDArray[Any], places: NDArray[Any] | None) -> None:
    writer_of = pytest.importorskip("mcap.writer", reason="mcap is not installed: pip install tactile-net[logs]")
    with open(path, "wb") as file:
        writer = writer_of.Writer(file)
        writer.start()
        schema = writer.register_schema("core.TactileDataArrayRecord", "flatbuffer", forces_schema())
        channel = writer.register_channel("left/tactile", "flatbuffer", schema)
        if places is not None:
            other = writer.register_schema("core.TactileMetadata", "flatbuffer", layout_schema())
            of = writer.register_channel("left/tactile_metadata", "flatbuffer", other)
            writer.add_message(of, 0, layout(places), 0)
        for k, one in enumerate(forces):
            writer.add_message(channel, 10**9 + 10**7 * k, record(one), 0)
        writer.finish()


def test_isaac(tmp_path: Path) -> None:
    geometry = flat_grid(6, 5)
    forces = RNG.normal(size=(4, 30, 3)).astype(np.float32)
    path = tmp_path / "run.mcap"
    isaac_log(path, forces, geometry.positions)
    assert list(sensors.sniffed(path)) == ["isaac"]
    with pytest.raises(tn.InputError, match="not say along which axes the forces of left/tactile are"):
        tn.load(path, sensor="isaac", **PAD)
    taken = tn.load(path, frame="sensor", gain=(1, 1, -1), **PAD)
    assert np.array_equal(taken.frames.readings, forces.astype(float) * [1, 1, -1]) and taken.frames.units == "N"
    assert np.allclose(taken.geometry.positions, geometry.positions, atol=1e-9)
    assert taken.frames.t is not None and np.allclose(taken.frames.t, 0.01 * np.arange(4))
    newtons = taken.solve().to_point_set("isaac")
    assert newtons.values.shape == newtons.sigma.shape == forces.shape
    isaac_log(path, forces, None)
    with pytest.raises(tn.InputError, match="has no poses of the 30 taxels"):
        tn.load(path, frame="sensor", sensor="isaac", **PAD)
    with pytest.raises(tn.InputError, match="has no topic of forces '/right'"):
        tn.load(path, frame="sensor", sensor="isaac", name="/right", **PAD)
    assert len(tn.load(path, frame="sensor", sensor="isaac", geometry=geometry, **PAD)) == 4


@pytest.mark.parametrize("seed", range(30))
def test_a_broken_flatbuffer_is_refused(seed: int) -> None:
    """Whatever a byte is changed to: numbers, or a ValueError; never memory beside the message."""
    from tactile_net.sensors import _flatbuffer

    rng = np.random.default_rng(seed)
    schema, message = bytearray(layout_schema()), bytearray(layout(np.ones((5, 3))))
    for data in (schema, message):
        for at in rng.integers(8, len(data), 3):
            data[at] = rng.integers(256)
    try:
        for columns in _flatbuffer.Schema(bytes(schema)).arrays(bytes(message)).values():
            assert all(len(one) * 4 <= len(message) for one in columns.values())
    except (ValueError, UnicodeDecodeError, RecursionError):
        pass


# MuJoCo, mjlab, DEX-01: simulators.

TIP = """<mujoco><asset><mesh name="tip" builtin="sphere" params="2" scale=".01 .01 .01"/></asset><worldbody>
<body><geom name="g" type="mesh" mesh="tip"/></body>
<body pos="0 0 .018"><freejoint/><geom type="sphere" size=".01" mass=".05"/></body></worldbody>
<sensor><clock/><tactile name="touch" geom="g" mesh="tip"/></sensor></mujoco>"""


def test_mujoco(tmp_path: Path) -> None:
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install tactile-net[mujoco]")
    (tmp_path / "tip.xml").write_text(TIP)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "tip.xml"))
    data = mujoco.MjData(model)
    rows, times = [], []
    for _ in range(40):
        mujoco.mj_step(model, data)
        rows.append(data.sensordata.copy())
        times.append(data.time)
    path = tmp_path / "run.npz"
    np.savez(path, sensordata=np.array(rows), time=np.array(times))
    assert list(sensors.sniffed(path)) == ["mujoco"]
    with pytest.raises(tn.InputError, match="neither a stress nor a displacement of a pad"):
        tn.load(path, **PAD)
    with pytest.raises(tn.InputError, match="says not of which model"):
        sensors.frames(path)
    given = {"model": str(tmp_path / "tip.xml")}
    frames, geometry = sensors.frames(path, **given), sensors.geometry(path, **given)
    assert frames.readings.shape == (40, model.nmeshvert, 3) and len(geometry) == model.nmeshvert
    radial = geometry.positions / np.linalg.norm(geometry.positions, axis=1, keepdims=True)
    assert np.einsum("ij,ij->i", geometry.normals, radial).min() > 0.9
    deepest = int(np.argmax(frames.readings[-1, :, 0]))
    assert frames.readings[-1, deepest, 0] > 1e-4 and geometry.normals[deepest, 2] > 0.9, "where the ball lies"
    with pytest.raises(tn.InputError, match="has no sensor tactile 'other'"):
        sensors.frames(path, name="other", **given)


def test_mjlab(tmp_path: Path) -> None:
    """The shapes of its documented data, (B, r, c) and (B, r, c, 2); no released wheel has the sensor yet."""
    depth, slip = RNG.random((3, 10, 7)) * 1e-3, RNG.random((3, 10, 7, 2))
    path = tmp_path / "run.npz"
    np.savez(path, depth=depth, slip=slip, time=[0.0, 0.1, 0.2])
    assert list(sensors.sniffed(path)) == ["mjlab"]
    with pytest.raises(tn.InputError, match="takes a contact solver"):
        tn.load(path, **PAD)
    frames = sensors.frames(path)
    assert np.array_equal(frames.readings[..., 0].reshape(depth.shape), depth)
    assert np.array_equal(frames.readings[..., 1:].reshape(slip.shape), slip)
    assert sensors.geometry(path, pitch=1e-3).flat
    np.savez(path, depth=depth, slip=slip[:2])
    with pytest.raises(tn.InputError, match="not depth \\(frames, rows, columns\\)"):
        sensors.frames(path, "mjlab")


def test_dex01(tmp_path: Path) -> None:
    """Forces by taxel and by pixel are the same; places and normals are the pattern's."""
    geometry = flat_grid(12, 10, 1e-3)
    poses = np.zeros((120, 3, 4))
    poses[:, :, :3], poses[:, :, 3] = np.eye(3), geometry.positions
    *pixels_of, free = np.stack(np.unravel_index(RNG.permutation(32 * 32)[:121], (32, 32)), axis=1)
    pixels = np.array(pixels_of)
    pattern = tmp_path / "pattern.npz"
    np.savez(pattern, poses=poses, taxel2pixel=pixels)
    forces = bump(geometry, 0.02)[np.newaxis] * np.array([[0.0], [1.0]])
    path, frames_path = tmp_path / "run.npz", tmp_path / "frames.npz"
    np.savez(path, normal_forces=forces, t=[0.0, 0.01])
    images = np.zeros((2, 32, 32))
    images[:, pixels[:, 0], pixels[:, 1]] = forces
    np.savez(frames_path, frames=images)
    assert list(sensors.sniffed(path)) == ["dex01"]
    with pytest.raises(tn.InputError, match="has no places of its taxels"):
        tn.load(path, sensor="dex01", **PAD)
    taken = tn.load(path, model=str(pattern), **PAD)
    other = tn.load(frames_path, sensor="dex01", model=str(pattern), **PAD)
    assert np.array_equal(taken.frames.readings[..., 0], forces) and np.array_equal(
        other.frames.readings, taken.frames.readings
    )
    found = tn.load(path, model=str(pattern), depth=1e-3, **PAD).solve().normal_force
    assert found[1] == pytest.approx(forces[1].sum(), rel=0.1) and abs(found[0]) < 1e-9
    images[0, free[0], free[1]] = 1.0
    np.savez(frames_path, frames=images)
    with pytest.raises(tn.InputError, match="forces at pixels of no taxel"):
        tn.load(frames_path, sensor="dex01", model=str(pattern), **PAD)
    np.savez(path, normal_forces=-forces)
    with pytest.raises(tn.InputError, match="normal forces below 0"):
        tn.load(path, model=str(pattern), **PAD)


# FlexiTac, AnySkin, BioTac, XELA.


def flexitac_stream(frames: NDArray[np.uint8], before: bytes = b"") -> bytes:
    return before + b"".join(b"\xaa\x55" + one.tobytes() for one in frames)


def test_flexitac(tmp_path: Path) -> None:
    """The bytes of the wire, cut into frames as its own package cuts them."""
    package = pytest.importorskip("flexitac.sensor", reason="flexitac is not installed")
    geometry = flat_grid(12, 32)
    counts = (20 + np.array([[0.0], [1.0], [0.5]]) * bump(geometry, 150)).astype(np.uint8).reshape(3, 12, 32)
    path = tmp_path / "run.bin"
    path.write_bytes(flexitac_stream(counts, b"\x00\x01\x02") + b"\xaa\x55\x00")
    reader = package.FlexiTacSensor("none")
    reader._buf = bytearray(path.read_bytes())
    theirs = []
    while (frame := reader._pop_frame()) is not None:
        theirs.append(frame)
    assert np.array_equal(theirs, counts)
    assert list(sensors.sniffed(path)) == ["flexitac"]
    with pytest.raises(tn.InputError, match="says not what one count is"):
        tn.load(path, pitch=2e-3, **PAD)
    with pytest.raises(tn.InputError, match="not how far they are apart"):
        tn.load(path, gain=1e-3, units="N", **PAD)
    taken = tn.load(path, gain=2e-3, units="N", pitch=2e-3, depth=1.5e-3, **PAD)
    assert np.allclose(
        taken.frames.readings[:, :, 0], 2e-3 * (counts.astype(float) - counts[0]).reshape(3, -1), atol=1e-15
    )
    assert taken.frames.t is None and any("6 bytes" in one for one in taken.notes)
    solution = taken.solve()
    pressed = taken.frames.readings.sum(axis=(1, 2))
    assert solution.normal_force[1:] == pytest.approx(pressed[1:], rel=0.1)
    np.save(tmp_path / "raw.npy", counts)
    again = tn.load(tmp_path / "raw.npy", sensor="flexitac", gain=2e-3, units="N", pitch=2e-3, **PAD)
    assert np.array_equal(again.frames.readings, taken.frames.readings)
    reader.calibrate = lambda n=None: None  # type: ignore[method-assign]
    reader._baseline = counts[0].astype(np.float32)
    np.save(tmp_path / "normalized.npy", np.stack([reader._normalize(one) for one in counts]))
    with pytest.raises(tn.InputError, match="divided by each frame's own peak"):
        tn.load(tmp_path / "normalized.npy", sensor="flexitac", gain=1.0, units="N", pitch=2e-3, **PAD)
    with pytest.raises(tn.InputError, match="frames of 16 x 32 between markers"):
        tn.load(path, sensor="flexitac", model="16x32", gain=1.0, units="N", pitch=2e-3, **PAD)


@pytest.mark.parametrize("temperatures", [False, True])
def test_anyskin(temperatures: bool, tmp_path: Path) -> None:
    """Its dummy's samples, in the rows of its get_data."""
    package = pytest.importorskip("anyskin.sensor", reason="anyskin is not installed")
    dummy = package.AnySkinDummy.__new__(package.AnySkinDummy)
    package.AnySkinDummy.__init__(dummy, num_mags=5, temp_filtered=not temperatures)
    rows = []
    for _ in range(9):
        time, *_, sample = dummy.get_sample()
        rows.append(np.concatenate([[time], sample]))
    path = tmp_path / "anyskin.npy"
    np.save(path, np.array(rows))
    assert list(sensors.sniffed(path)) == ["anyskin"]
    with pytest.raises(tn.InputError, match="it reads magnetic fields"):
        tn.load(path, **PAD)
    frames = sensors.frames(path)
    assert frames.readings.shape == (9, 5, 3) and frames.units == "T"
    fields = np.array(rows)[:, 1:].reshape(9, 5, -1)[..., -3:]
    assert np.array_equal(frames.readings, fields)
    np.save(path, np.zeros((4, 13)))
    with pytest.raises(tn.InputError, match="3 or 4 a chip"):
        sensors.frames(path, "anyskin")


def test_biotac(tmp_path: Path) -> None:
    """A CSV that haptix' own adapter takes."""
    package = pytest.importorskip("haptix.sensors.biotac", reason="haptix is not installed")
    names = [*(f"E{k}" for k in range(1, 20)), "PDC", "PAC", "TDC", "TAC"]
    numbers = RNG.integers(0, 4096, size=(6, 23))
    path = tmp_path / "run.csv"
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([names, *numbers.tolist()])
    adapter = package.BioTacAdapter()
    assert adapter.can_load(path)
    assert list(sensors.sniffed(path)) == ["biotac"]
    with pytest.raises(tn.InputError, match="impedances of a fluid"):
        tn.load(path, **PAD)
    frames = sensors.frames(path)
    assert np.array_equal(frames.readings[..., 0], numbers)
    path.write_text(path.read_text().replace("E7", "E70"))
    with pytest.raises(tn.InputError, match="no column of the electrodes e7"):
        sensors.frames(path, "biotac")


def xela_message(time: float, triples: NDArray[Any], calibrated: NDArray[Any] | None = None) -> str:
    """As its server sends them, which two public clients take apart: hexadecimal counts, and newtons if calibrated."""
    sensor: dict[str, Any] = {"sensor": "1", "taxels": len(triples), "time": time, "model": "uSPa46"}
    sensor["data"] = ",".join(f"{one:04X}" for one in triples.ravel())
    sensor["calibrated"] = None if calibrated is None else calibrated.ravel().tolist()
    return json.dumps({"message": 1, "type": "routine", "time": time, "sensors": 1, "1": sensor})


def test_xela(tmp_path: Path) -> None:
    newtons = np.zeros((3, 24, 3))
    # The skin's x is into the pad, against the sensor's z; its rows and columns are along the sensor's y and x.
    skin = lattice_skin(6, 4, 2e-3, reads=("stress_x", "shear_xy", "shear_xz"))
    stress = skin.simulate().readings[0].transpose(1, 0, 2).reshape(24, 3)
    newtons[1:] = 2e-3**2 * np.stack([stress[:, 2], stress[:, 1], stress[:, 0]], axis=1)
    counts = np.rint(30000 + 1000 * newtons).astype(int)
    path = tmp_path / "run.jsonl"
    lines = [xela_message(0.1 * k, one) for k, one in enumerate(counts)]
    path.write_text("\n".join([*lines, '{"message": 2, "type": "welcome"}', ""]))
    assert list(sensors.sniffed(path)) == ["xela"]
    given: dict[str, Any] = {"model": "4x6", "pitch": 2e-3} | PAD
    with pytest.raises(tn.InputError, match="says not what one count is"):
        tn.load(path, **given)
    taken = tn.load(path, gain=(1e-3, 1e-3, -1e-3), units="N", **given)
    assert np.allclose(taken.frames.readings, newtons * [1, 1, -1], atol=1e-3)
    assert taken.frames.t is not None and np.allclose(taken.frames.t, [0.0, 0.1, 0.2])
    path.write_text("\n".join(xela_message(0.1 * k, counts[k], newtons[k]) for k in range(3)))
    with pytest.raises(tn.InputError, match="not say in which unit its forces are"):
        tn.load(path, **given)
    calibrated = tn.load(path, units="N", gain=(1, 1, -1), **given)
    assert np.allclose(calibrated.frames.readings, newtons * [1, 1, -1], atol=1e-12)
    force = calibrated.solve().to_point_set("isaac").values[1].sum(axis=0)
    assert force[2] == pytest.approx(-1.0, rel=0.1)
    with pytest.raises(tn.InputError, match=r'geometry=, or model="4x6"'):
        tn.load(path, units="N", **PAD)
    path.write_text(xela_message(0.0, counts[0]) + "\n{broken\n")
    with pytest.raises(tn.InputError, match="no message of JSON in line 2"):
        tn.load(path, sensor="xela", gain=1.0, units="N", **given)
    path.write_text(xela_message(0.0, counts[0]) + "\n" + xela_message(0.1, counts[0, :20]))
    with pytest.raises(tn.InputError, match="messages of \\[60, 72\\] numbers"):
        tn.load(path, sensor="xela", gain=1.0, units="N", **given)


def test_xela_refuses_what_no_server_sends(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    given: dict[str, Any] = {"model": "2x2", "pitch": 2e-3} | PAD
    path.write_text('{"a":' * 10_000)
    assert not sensors.sniffed(path)
    with pytest.raises(tn.InputError, match="no message of JSON in line 1"):
        tn.load(path, sensor="xela", gain=1.0, units="N", **given)
    huge = "9" * 400
    rest = ", 1" * 11
    path.write_text(f'{{"1": {{"calibrated": [{huge}{rest}]}}}}')
    with pytest.raises(tn.InputError, match="a reading that is no number"):
        tn.load(path, sensor="xela", units="N", **given)
    path.write_text('{"1": {"data": "%s%s"}}' % ("F" * 400, ",1" * 11))
    with pytest.raises(tn.InputError, match="a reading that is no number"):
        tn.load(path, sensor="xela", gain=1.0, units="N", **given)


@pytest.mark.parametrize("shape", ["(100000000000, 3)", "(1000000000000000000000000, 3)", "((("])
def test_archives_whose_headers_lie_are_refused(shape: str, tmp_path: Path) -> None:
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}".encode().ljust(117) + b"\n"
    array = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + bytes(48)
    for changes in ({}, {8: 99}, {6: 1}):  # a method of compression, a password
        stored = io.BytesIO()
        with zipfile.ZipFile(stored, "w") as archive:
            archive.writestr("normal_forces.npy", array)
        data = bytearray(stored.getvalue())
        entry = data.index(b"PK\x01\x02")
        for at, value in changes.items():
            data[at] = data[entry + at + 2] = value
        path = tmp_path / "run.npz"
        path.write_bytes(data)
        with pytest.raises(tn.InputError, match=r"is no \.npz file"):
            arrays_in(str(path))
        with pytest.raises(tn.InputError, match="normal_forces: "):
            read_npz(str(path), None)
    path = tmp_path / "run.npy"
    path.write_bytes(array)
    if shape == "(((":
        with pytest.raises(tn.InputError, match="header that cannot be read"):
            array_in(str(path))


# Points.


def test_points_are_what_anybody_writes(tmp_path: Path) -> None:
    (tmp_path / "taxels.csv").write_text(
        "name,x [mm],y [mm],z [mm]\n" + "".join(f"p{k},{2 * (k % 4)},{2 * (k // 4)},0\n" for k in range(12))
    )
    names = [f"{short}_p{k}" for k in range(12) for short in ("dx", "dy", "dz")]
    values = RNG.normal(size=(3, 36))
    out = io.StringIO()
    csv.writer(out).writerows([["frame", *names], *([k, *one] for k, one in enumerate(values.tolist()))])
    path = tmp_path / "run.csv"
    path.write_text(out.getvalue())
    assert list(sensors.sniffed(path)) == ["points"]
    with pytest.raises(tn.InputError, match="not say along which axes its displacements are"):
        tn.load(path, **SOFT)
    with pytest.raises(tn.InputError, match="not say in which unit its displacements are"):
        tn.load(path, frame="sensor", **SOFT)
    taken = tn.load(path, frame="sensor", units="um", **SOFT)
    assert np.allclose(taken.frames.readings, 1e-6 * values.reshape(3, 12, 3), rtol=1e-12)
    path.write_text(out.getvalue().replace("dy_p3", "dy_q3"))
    with pytest.raises(tn.InputError, match="has no column displacement_y_p3"):
        tn.load(path, sensor="points", frame="sensor", units="um", **SOFT)
    (tmp_path / "taxels.csv").unlink()
    with pytest.raises(tn.InputError, match="has no file of taxels beside it"):
        tn.load(path, sensor="points", frame="sensor", units="um", **SOFT)


@pytest.mark.parametrize("units", ["m", "N", "Pa"])
def test_points_come_back(units: str, tmp_path: Path) -> None:
    write: Callable[..., None] = sensors.adapter("points").write  # type: ignore[attr-defined]
    geometry = flat_grid(3, 4)
    readings = RNG.normal(size=(5, 12, 3))
    readings[2, 3, 1] = np.nan
    for frame, values in (("sensor", readings), ("local", readings), ("local", readings[..., :1])):
        frames = tn.Frames(values, 0.1 * np.arange(5), units, frame)
        write(tmp_path / "a.csv", geometry, frames)
        assert sensors.sniffed(tmp_path / "a.csv") == {"points": 1.0}
        again = sensors.frames(tmp_path / "a.csv")
        assert np.array_equal(again.readings, values, equal_nan=True)
        assert (
            (again.units, again.frame) == (units, frame) and again.t is not None and np.array_equal(again.t, frames.t)
        )
        assert np.array_equal(sensors.geometry(tmp_path / "a.csv").positions, geometry.positions)

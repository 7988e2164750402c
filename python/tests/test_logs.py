"""Logs of robots: what is written comes back, what others wrote is read by topic and field, what is broken is said."""

from __future__ import annotations

import dataclasses
import json
import subprocess
import sys
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from recordings import FLOATS, READINGS, SI, SMALL, UNITLESS, assert_same, bits

import tactile_net as tn

mcap_writer = pytest.importorskip("mcap.writer")
typesys = pytest.importorskip("rosbags.typesys")
rosbag1 = pytest.importorskip("rosbags.rosbag1")
rosbag2 = pytest.importorskip("rosbags.rosbag2")

STATE = """std_msgs/Header header
sensor_msgs/ChannelFloat32[] sensors
"""
HAND = """std_msgs/Header header
float64 temperature
Finger[2] fingers
================================================================================
MSG: mine/Finger
float32[] taxels
string name
"""
ROS1 = typesys.get_typestore(typesys.Stores.ROS1_NOETIC)
ROS2 = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
for store in (ROS1, ROS2):
    store.register(typesys.get_types_from_msg(STATE, "tactile_msgs/msg/TactileState"))
    store.register(typesys.get_types_from_msg(HAND.partition("=")[0], "mine/msg/Hand"))
    store.register(typesys.get_types_from_msg("float32[] taxels\nstring name\n", "mine/msg/Finger"))


def header(store: Any, stamp: int) -> Any:
    time = store.types["builtin_interfaces/msg/Time"](*divmod(stamp, 10**9))
    name = store.types["std_msgs/msg/Header"]
    return name(0, time, "pad") if store is ROS1 else name(time, "pad")


def image(store: Any, values: Any, encoding: str, stamp: int = 0, padding: int = 0, big: bool = False) -> Any:
    values = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder(">" if big else "<"))
    rows = np.pad(values.view(np.uint8).reshape(len(values), -1), ((0, 0), (0, padding)))
    of = store.types["sensor_msgs/msg/Image"]
    return of(header(store, stamp), *values.shape, encoding, int(big), rows.shape[1], rows.reshape(-1))


def multi_array(store: Any, values: Any, kind: str) -> Any:
    layout = store.types["std_msgs/msg/MultiArrayLayout"]([], 2)
    return store.types[f"std_msgs/msg/{kind}"](
        layout, np.concatenate([[-1, -1], values.reshape(-1)]).astype(values.dtype)
    )


def state(store: Any, values: Any) -> Any:
    of = store.types["sensor_msgs/msg/ChannelFloat32"]
    sensors = [of(f"channel {k}", row) for k, row in enumerate(values.astype(np.float32))]
    return store.types["tactile_msgs/msg/TactileState"](header(store, 0), sensors)


def hand(store: Any, values: Any) -> Any:
    finger = store.types["mine/msg/Finger"]
    fingers = [finger(row.astype(np.float32), f"finger {k}") for k, row in enumerate(values)]
    return store.types["mine/msg/Hand"](header(store, 0), 36.6, fingers)


# Each takes one frame of READINGS; all its numbers are small and whole.
MESSAGES: dict[str, tuple[str, Callable[[Any, Any], Any], str | None]] = {
    "64FC1": ("sensor_msgs/msg/Image", lambda to, x: image(to, x, "64FC1"), None),
    "32FC1, padded": ("sensor_msgs/msg/Image", lambda to, x: image(to, x.astype("f4"), "32FC1", padding=5), None),
    "64FC1, big-endian": ("sensor_msgs/msg/Image", lambda to, x: image(to, x, "64FC1", big=True), None),
    "Float32MultiArray": (
        "std_msgs/msg/Float32MultiArray",
        lambda to, x: multi_array(to, x.astype("f4"), "Float32MultiArray"),
        None,
    ),
    "Float64MultiArray": (
        "std_msgs/msg/Float64MultiArray",
        lambda to, x: multi_array(to, x, "Float64MultiArray"),
        None,
    ),
    "TactileState": ("tactile_msgs/msg/TactileState", state, None),
    "a field of a list": ("mine/msg/Hand", hand, "fingers.taxels"),
}


def mcap(path: Path, topics: dict[str, tuple[Any, str, list[tuple[int, Any]]]], **how: Any) -> None:
    """By topic: store, type, and messages with their log times."""
    with open(path, "wb") as file:
        writer = mcap_writer.Writer(file, **how)
        writer.start()
        for topic, (store, kind, messages) in topics.items():
            old = store is ROS1
            text, _ = store.generate_msgdef(kind, ros_version=1 if old else 2)
            name = kind.replace("/msg/", "/") if old else kind
            schema = writer.register_schema(name, "ros1msg" if old else "ros2msg", text.encode())
            channel = writer.register_channel(topic, "ros1" if old else "cdr", schema)
            serialize = store.serialize_ros1 if old else store.serialize_cdr
            for time, message in messages:
                writer.add_message(channel, time, bytes(serialize(message, kind)), time)
        writer.finish()


def bag(path: Path, topics: dict[str, tuple[Any, str, list[tuple[int, Any]]]], **how: Any) -> None:
    """Of ROS 2 with a storage, else of ROS 1."""
    two = "storage_plugin" in how
    compression = how.pop("compression", None)
    writer = rosbag2.Writer(path, version=9, **how) if two else rosbag1.Writer(path)
    if compression is not None:
        writer.set_compression(compression)
    with writer:
        for topic, (store, kind, messages) in topics.items():
            connection = writer.add_connection(topic, kind, typestore=store)
            serialize = store.serialize_cdr if two else store.serialize_ros1
            for time, message in messages:
                writer.write(connection, time, serialize(message, kind))


CONTAINERS: dict[str, tuple[Any, Callable[..., None], dict[str, Any]]] = {
    "mcap": (ROS2, mcap, {}),
    "mcap, lz4": (ROS2, mcap, {"compression": mcap_writer.CompressionType.LZ4}),
    "mcap, no chunks": (ROS2, mcap, {"use_chunking": False}),
    "mcap of ROS 1": (ROS1, mcap, {}),
    "ROS 1": (ROS1, bag, {}),
    "ROS 1, bz2": (ROS1, bag, {"compression": rosbag1.Writer.CompressionFormat.BZ2}),
    "ROS 1, lz4": (ROS1, bag, {"compression": rosbag1.Writer.CompressionFormat.LZ4}),
    "ROS 2, SQLite": (ROS2, bag, {"storage_plugin": rosbag2.StoragePlugin.SQLITE3}),
    "ROS 2, MCAP": (ROS2, bag, {"storage_plugin": rosbag2.StoragePlugin.MCAP}),
}


@pytest.mark.parametrize("container", CONTAINERS.values(), ids=CONTAINERS.keys())
@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES.keys())
def test_a_topic_and_a_field_are_read(container: Any, message: Any, tmp_path: Path) -> None:
    store, write, how = container
    kind, make, field = message
    chatter = store.types["std_msgs/msg/String"]("hello")
    frames = [(10**9 + k * 10**7, make(store, one)) for k, one in enumerate(READINGS)]
    write(
        tmp_path / "log",
        {"/chatter": (store, "std_msgs/msg/String", [(5, chatter)]), "/pad": (store, kind, frames)},
        **how,
    )
    recording = tn.logs.read(tmp_path / "log", topic="/pad", field=field, scene=SMALL)
    assert np.array_equal(recording.readings, SI)
    assert recording.t is not None and np.array_equal(recording.t, [1.0, 1.01, 1.02, 1.03])
    if field is None:
        assert bits(tn.load(tmp_path / "log", scene=SMALL, units="kPa").readings) == bits(SI), (
            "the only topic of its kind"
        )


@st.composite
def recordings(draw: st.DrawFn) -> tn.Recording:
    scene = draw(st.sampled_from([SMALL, UNITLESS]))
    frames = draw(st.integers(0, 4))
    readings = draw(arrays.arrays(np.float64, (frames, 2, 3), elements=st.floats()))
    pressed = arrays.arrays(np.float64, (frames, 1, len(scene.y)), elements=FLOATS)
    truth = draw(st.none() | pressed) if frames > 0 else None  # no message, no shape
    first = draw(st.integers(0, 2**22 * 10**9))  # a double holds their nanoseconds
    stamps = first + np.cumsum(draw(arrays.arrays(np.int64, frames, elements=st.integers(0, 10**9))))
    t = draw(st.sampled_from([None, stamps // 10**9 + stamps % 10**9 / 1e9]))
    return tn.Recording(scene, readings, t, truth, ("a note",))


@given(recording=recordings())
@settings(max_examples=30)
def test_what_is_written_comes_back_bit_by_bit(
    recording: tn.Recording, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("log") / "run.mcap"
    tn.logs.write(path, recording)
    again = tn.load(path)
    assert_same(again, recording)
    assert bits(again.readings) == bits(recording.readings)
    path.unlink()
    recording.save(path, name="left")
    assert_same(tn.logs.read(path, topic="/left"), recording)


def test_stamps_are_whole_nanoseconds(two: tn.Scene, tmp_path: Path) -> None:
    stamps = 1_767_225_600_000_000_000 + np.array([1, 10_000_003, 20_000_000, 20_000_000, 40_000_000])
    t = stamps // 10**9 + stamps % 10**9 / 1e9
    recording = dataclasses.replace(two.simulate(), t=t)
    tn.logs.write(tmp_path / "a.mcap", recording)
    assert bits(tn.load(tmp_path / "a.mcap").t) == bits(t)
    told = [(one.log_time, one.stamp) for one in tn.logs.messages(tmp_path / "a.mcap")]
    assert all(time == stamp for time, stamp in told)
    assert np.abs(np.array([stamp for _, stamp in told]) - stamps).max() <= 120, "half a step of a double in 2026"


def test_a_solution_is_written_for_viewers(two: tn.Scene, tmp_path: Path) -> None:
    solution = two.simulate().solve()
    solution.save(tmp_path / "run.mcap")
    pressed = [one.values for one in tn.logs.messages(tmp_path / "run.mcap", topic="/pad/tractions")]
    assert bits(np.array(pressed)) == bits(solution.tractions)
    log = tmp_path / "run.mcap"
    for field, expected in (
        ("wrench.force.x", solution.normal_force),
        ("wrench.force.y", solution.tangential_force),
        ("wrench.torque.z", -solution.normal_force * solution.centre),
    ):
        found = np.array([float(one.values) for one in tn.logs.messages(log, topic="/pad/contact", field=field)])
        assert np.allclose(found, expected, rtol=1e-12, atol=1e-12)
    assert bits(tn.load(log).readings) == bits(solution.recording.readings)
    with pytest.raises(
        tn.InputError, match="/pad/tractions has tractions, not readings\nhint: tactile_net.logs.messages"
    ):
        tn.logs.read(log, topic="/pad/tractions")
    with pytest.raises(tn.InputError, match="holds readings and no solution"):
        tn.Solution.load(log)


def test_other_programs_find_the_scene_in_the_metadata(two: tn.Scene, tmp_path: Path) -> None:
    reader = pytest.importorskip("mcap.reader")
    tn.logs.write(tmp_path / "run.mcap", two.simulate(), dtype="float32")
    with open(tmp_path / "run.mcap", "rb") as file:
        opened = reader.make_reader(file)
        (record,) = opened.iter_metadata()
        (_, _, message), *_ = opened.iter_messages(topics="/pad")
    assert record.name == "tactile_net" and record.metadata["scene"] == two.text
    assert json.loads(record.metadata["units"]) == {"stress_x": "", "shear_xy": ""}
    assert record.metadata["channels"] == "stress_x,shear_xy"
    shown = ROS2.deserialize_cdr(message.data, "sensor_msgs/msg/Image")
    assert (shown.height, shown.width, shown.encoding, shown.header.frame_id) == (2, 21, "32FC1", "pad")


def test_uneven_arrays_are_one_row(uneven: tn.Scene, tmp_path: Path) -> None:
    recording = uneven.simulate()
    recording.save(tmp_path / "a.mcap")
    assert bits(tn.load(tmp_path / "a.mcap").readings) == bits(recording.readings)


def test_blocks_are_the_recording_piece_by_piece(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.replace({"time.frames": 25}).simulate()
    tn.logs.write(tmp_path / "a.mcap", recording)
    pieces = list(tn.logs.blocks(tmp_path / "a.mcap", frames=10))
    assert [len(one) for one in pieces] == [10, 10, 5]
    assert bits(np.concatenate([one.readings for one in pieces])) == bits(recording.readings)
    assert bits(np.concatenate([one.t for one in pieces])) == bits(recording.t)  # type: ignore[misc]
    averaging = SMALL.replace({"calibration": {"baseline_frames": [0, 3]}})
    with pytest.raises(ValueError, match="baseline is the mean of the first frames, which later blocks do not have"):
        next(tn.logs.blocks(tmp_path / "a.mcap", scene=averaging))


def test_a_long_log_takes_constant_memory(tmp_path: Path) -> None:
    """Pictures of 120 MB in all, of which it holds one or two at a time."""
    values = np.zeros((2, 3))
    picture = image(ROS2, np.zeros((1000, 1250)), "64FC1")
    pads = [(k, image(ROS2, values, "64FC1", stamp=k + 1)) for k in range(2)]
    log = tmp_path / "long.mcap"
    mcap(
        log,
        {
            "/pad": (ROS2, "sensor_msgs/msg/Image", pads),
            "/camera": (ROS2, "sensor_msgs/msg/Image", [(k, picture) for k in range(12)]),
        },
    )
    script = (
        "import sys, re, tactile_net as tn\n"
        "def highest():\n"
        "    return int(re.search(r'VmHWM:\\s+(\\d+)', open('/proc/self/status').read())[1])\n"
        "print(sum(1 for one in tn.logs.messages(sys.argv[1], topic='/pad')))\n"
        "before = highest()\n"
        "print(sum(1 for one in tn.logs.messages(sys.argv[1], topic='/camera')))\n"
        "print(highest() - before)\n"
    )
    done = subprocess.run([sys.executable, "-c", script, log], capture_output=True, text=True, check=True)
    frames, pictures, kilobytes = map(int, done.stdout.split())
    assert (frames, pictures) == (2, 12)
    assert kilobytes < 60_000


# What is broken.


def log_of(path: Path, messages: list[Any], times: Any = None, kind: str = "sensor_msgs/msg/Image", **how: Any) -> Path:
    stamped = [(int(time), one) for time, one in zip(range(1, 1 + len(messages)) if times is None else times, messages)]
    mcap(path, {"/pad": (ROS2, kind, stamped)}, **how)
    return path


def string(text: str) -> Any:
    return ROS2.types["std_msgs/msg/String"](text)


@pytest.mark.parametrize("container", ["mcap", "ROS 1", "ROS 2, SQLite"])
def test_topics_and_fields_that_are_not_there(container: str, tmp_path: Path) -> None:
    store, write, how = CONTAINERS[container]
    log = tmp_path / "log"
    write(log, {"/hand": (store, "mine/msg/Hand", [(1, hand(store, READINGS[0]))])}, **how)
    with pytest.raises(
        tn.InputError, match=r"log: error: has no topic '/pad'; topics: /hand \(mine/(msg/)?Hand\)\nhint: topic="
    ):
        tn.logs.read(log, topic="/pad", scene=SMALL)
    with pytest.raises(tn.InputError, match=r"does not say which topic has the readings; topics: /hand \(mine"):
        tn.logs.read(log, scene=SMALL)
    with pytest.raises(tn.InputError, match=r"/hand holds mine/.*Hand; without field= are read: sensor_msgs/Image, "):
        tn.logs.read(log, topic="/hand", scene=SMALL)
    for field, words in (
        ("taxels", "has no field 'taxels' of 'taxels'; there are header, temperature, fingers"),
        ("fingers.skin", "has no field 'skin' of 'fingers.skin'; there are taxels, name"),
        ("fingers[2].taxels", r"has no number 2 of 2 in 'fingers\[2\].taxels'"),
        ("fingers", "has no numbers in 'fingers'; it has taxels, name"),
        ("fingers[0].name", r"has no numbers in 'fingers\[0\].name'"),
    ):
        with pytest.raises(tn.InputError, match=f"frame 0 of /hand {words}"):
            tn.logs.read(log, topic="/hand", field=field, scene=SMALL)
    with pytest.raises(tn.InputError, match=r"/hand has readings of the shape \(1, 3\), not \(frames, 2, 3\)"):
        tn.logs.read(log, topic="/hand", field="fingers[1].taxels", scene=SMALL)
    with pytest.raises(tn.InputError, match="/hand says no scene that its readings are of\nhint: give scene="):
        tn.logs.read(log, topic="/hand", field="fingers.taxels")


def test_messages_that_are_no_frames(tmp_path: Path) -> None:
    frame = READINGS[0]
    good = image(ROS2, frame, "64FC1")
    for bad, words in (
        (
            [image(ROS2, frame.T.copy(), "64FC1")],
            r"of the shape \(1, 3, 2\), .*\nhint: its axes are exchanged: .*\(0, 2, 1\)",
        ),
        ([image(ROS2, frame[:, :2].copy(), "64FC1")], r"of the shape \(1, 2, 2\), not \(frames, 2, 3\)"),
        ([good, good, image(ROS2, frame[:1], "64FC1")], "frame 2 of /pad has 3 readings, those before it have 6"),
        (
            [dataclasses.replace(good, encoding="rgb8")],
            "frame 0 of /pad is an image in 'rgb8'; readable are 32FC1, 64FC1, mono16",
        ),
        (
            [good, dataclasses.replace(good, height=3)],
            "frame 1 of /pad is an image of 48 bytes, not 3 rows of 24: it is broken",
        ),
        ([dataclasses.replace(good, step=8)], "is an image of 48 bytes, not 2 rows of 24"),
        ([image(ROS2, frame.astype("u2"), "mono16")], r"/pad has whole numbers \(uint16\), as a converter gives"),
    ):
        with pytest.raises(tn.InputError, match=words):
            tn.logs.read(log_of(tmp_path / "log", bad), scene=SMALL)
    scaled = SMALL.replace({"calibration": {"gain": 0.5, "baseline": 1.0}})
    log = log_of(tmp_path / "log", [image(ROS2, frame.astype("u2"), "mono16")])
    assert np.allclose(tn.logs.read(log, scene=scaled).readings, (SI[:1] - [[1e3], [1.0]]) / 2, rtol=1e-12)


def test_stamps_that_cannot_be_trusted_give_way_to_log_times(tmp_path: Path) -> None:
    def read(stamps: list[int], times: list[int], **how: Any) -> tn.Recording:
        messages = [image(ROS2, one, "64FC1", stamp=stamp) for one, stamp in zip(READINGS, stamps)]
        return tn.logs.read(log_of(tmp_path / "log", messages, times, **how), scene=SMALL)

    good = read([10, 20, 30, 40], [5, 6, 7, 8])
    assert good.t is not None and np.array_equal(good.t, [1e-8, 2e-8, 3e-8, 4e-8]) and good.notes == ()
    for stamps, note in (([0] * 4, "all stamps are 0"), ([10, 20, 15, 40], "stamps go back at frame 2")):
        recording = read(stamps, [5, 6, 7, 8])
        assert recording.t is not None and np.array_equal(recording.t, [5e-9, 6e-9, 7e-9, 8e-9])
        assert recording.notes == (f"{note}: times are those of the log",)
    for chunks in (True, False):  # by the index, or as they stand in the file
        mixed = read([0] * 4, [8, 6, 7, 5], use_chunking=chunks)
        assert mixed.t is not None and np.array_equal(mixed.t, [5e-9, 6e-9, 7e-9, 8e-9])
        assert np.array_equal(mixed.readings, SI[[3, 1, 2, 0]])
    assert mixed.notes[1] == "frames were not logged in the order of their times: they are sorted"


def test_times_that_are_no_stamps(two: tn.Scene, tmp_path: Path) -> None:
    recording = two.simulate()
    for bad in (-0.5, np.nan, np.inf, 3e9):
        t = np.array([0.0, 0.1, bad, 4e9, 5e9])
        with pytest.raises(ValueError, match=r"frame 2 is at .* s: stamps of logs are from 0 to 2\^31 s"):
            tn.logs.write(tmp_path / "a.mcap", dataclasses.replace(recording, t=t))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_what_a_crash_leaves_is_read_with_the_count(share: float, tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    recording = tn.Recording(SMALL, rng.normal(size=(20_000, 2, 3)), np.arange(20_000) * 1e-3)
    tn.logs.write(tmp_path / "run.mcap", recording)
    data = (tmp_path / "run.mcap").read_bytes()
    (tmp_path / "half.mcap").write_bytes(data[: int(share * len(data))])
    with pytest.warns(tn.CutOffWarning, match=r"half\.mcap: cut off: \d+ whole frames, then the end") as warned:
        again = tn.load(tmp_path / "half.mcap")
    assert 0.5 * share < len(again) / 20_000 <= 1.2 * share
    assert str(warned[0].message) == f"{tmp_path}/half.mcap: {again.notes[0]}"
    assert f"cut off: {len(again)} whole frames" in again.notes[0]
    assert bits(again.readings) == bits(recording.readings[: len(again)])
    assert again.scene.text == SMALL.text, "the metadata come first"
    with pytest.warns(tn.CutOffWarning, match=f"cut off: {len(again)} whole"):
        assert sum(map(len, tn.logs.blocks(tmp_path / "half.mcap", frames=1000))) == len(again)


def test_a_damaged_chunk_ends_a_log(tmp_path: Path) -> None:
    recording = tn.Recording(SMALL, np.random.default_rng(1).normal(size=(20_000, 2, 3)), np.arange(20_000) * 1e-3)
    tn.logs.write(tmp_path / "run.mcap", recording)
    with open(tmp_path / "run.mcap", "r+b") as file:
        chunk = pytest.importorskip("mcap.reader").make_reader(file).get_summary().chunk_indexes[1]
        file.seek(chunk.chunk_start_offset + 100_000)
        byte = file.read(1)[0]
        file.seek(-1, 1)
        file.write(bytes([byte ^ 0xFF]))
    with pytest.warns(tn.CutOffWarning, match="cut off: [1-9]"):
        again = tn.load(tmp_path / "run.mcap")
    assert 0 < len(again) < 20_000
    assert bits(again.readings) == bits(recording.readings[: len(again)])


def test_a_ros2_bag_whose_recorder_crashed(tmp_path: Path) -> None:
    """It has neither an index nor metadata.yaml."""
    frames = [(k, image(ROS2, READINGS[k % 4], "64FC1", stamp=k + 1)) for k in range(9000)]
    bag(tmp_path / "bag", {"/pad": (ROS2, "sensor_msgs/msg/Image", frames)}, storage_plugin=rosbag2.StoragePlugin.MCAP)
    (tmp_path / "bag/metadata.yaml").unlink()
    (storage,) = (tmp_path / "bag").glob("*.mcap")
    storage.write_bytes(storage.read_bytes()[:-2000])
    with pytest.warns(tn.CutOffWarning, match=r"bag: cut off: \d+ whole frames"):
        recording = tn.logs.read(tmp_path / "bag", scene=SMALL)
    assert len(recording) > 1000 and np.array_equal(recording.readings[:4], SI)


@pytest.mark.parametrize("container", [name for name in CONTAINERS if name.startswith("ROS 1")])
def test_half_a_bag_of_ros1(container: str, tmp_path: Path) -> None:
    """Its index stands at its end: ROS's own tool makes it again."""
    store, write, how = CONTAINERS[container]
    frames = [(k + 1, image(store, np.full((2, 3), k + 0.5), "64FC1", stamp=k + 1)) for k in range(900)]
    write(tmp_path / "log", {"/pad": (store, "sensor_msgs/msg/Image", frames)}, **how)
    data = (tmp_path / "log").read_bytes()
    for share in (0.01, 0.5, 0.99):
        (tmp_path / "half").write_bytes(data[: int(share * len(data))])
        with pytest.raises(
            tn.InputError, match=r"half: error: is not a whole bag: .*\nhint: reindex first: rosbag reindex .*half"
        ):
            tn.load(tmp_path / "half", scene=UNITLESS, units="scene")


def test_half_a_database(tmp_path: Path) -> None:
    store, write, how = CONTAINERS["ROS 2, SQLite"]
    frames = [(k, image(store, READINGS[k % 4], "64FC1", stamp=k + 1)) for k in range(2000)]
    log = tmp_path / "log"
    write(log, {"/pad": (store, "sensor_msgs/msg/Image", frames)}, **how)
    (log / "metadata.yaml").unlink()  # as a crash leaves it
    assert len(tn.logs.read(log, scene=SMALL)) == 2000
    (table,) = log.glob("*.db3")
    table.write_bytes(table.read_bytes()[: table.stat().st_size // 2])
    for path in (log, table):
        with pytest.raises(tn.InputError, match="is not a whole bag: .*malformed\nhint: reindex first: rosbag reindex"):
            tn.logs.read(path, scene=SMALL)


def test_files_that_are_no_logs(tmp_path: Path) -> None:
    for data, words in (
        (b"", "is empty"),
        (b"t,stress_x_0\n", "is neither MCAP nor a ROS bag"),
        (b"\x89MCAP0\r\n", "does not say which topic has the readings; topics: none"),
    ):
        (tmp_path / "log").write_bytes(data)
        with pytest.raises(tn.InputError, match=f"log: error: {words}"):
            tn.logs.read(tmp_path / "log", scene=SMALL)
    for data in (b"#ROSBAG V2.0\nabc", b"SQLite format 3\0abc"):
        (tmp_path / "log").write_bytes(data)
        with pytest.raises(tn.InputError, match="is not a whole bag: "):
            tn.logs.read(tmp_path / "log", scene=SMALL)
    (tmp_path / "empty").mkdir()
    with pytest.raises(tn.InputError, match="is not a whole bag: "):
        tn.load(tmp_path / "empty", scene=SMALL)


def raw_log(path: Path, encoding: str, messages: list[bytes], schema: tuple[str, str, bytes] | None = None) -> Path:
    with open(path, "wb") as file:
        writer = mcap_writer.Writer(file)
        writer.start()
        of = 0 if schema is None else writer.register_schema(*schema)
        channel = writer.register_channel("/pad", encoding, of)
        for time, data in enumerate(messages):
            writer.add_message(channel, time, data, time)
        writer.finish()
    return path


def test_other_encodings(tmp_path: Path) -> None:
    messages = [
        json.dumps({"skin": {"values": one.tolist()}, "header": {"stamp": {"sec": 7, "nsec": k}}})
        for k, one in enumerate(READINGS)
    ]
    log = raw_log(tmp_path / "a", "json", [one.encode() for one in messages], ("skin", "jsonschema", b"{}"))
    recording = tn.logs.read(log, topic="/pad", field="skin.values", scene=SMALL)
    assert np.array_equal(recording.readings, SI) and recording.t is not None and recording.t[0] == 7.0
    log = raw_log(tmp_path / "a", "protobuf", [b"x"], ("skin", "protobuf", b""))
    with pytest.raises(
        tn.InputError, match=r"has messages of /pad in protobuf \(protobuf\); readable are cdr and ros1 with"
    ):
        tn.logs.read(log, topic="/pad", field="x", scene=SMALL)
    text, _ = ROS2.generate_msgdef("sensor_msgs/msg/Image", ros_version=2)
    log = raw_log(tmp_path / "a", "cdr", [b"\0\1\0\0abc"], ("sensor_msgs/msg/Image", "ros2msg", text.encode()))
    with pytest.raises(tn.InputError, match="has a message of /pad that is not a sensor_msgs/msg/Image: "):
        tn.logs.read(log, scene=SMALL)
    log = raw_log(tmp_path / "a", "cdr", [b"x"], ("mine/msg/Skin", "ros2msg", b"float64[ values"))
    with pytest.raises(tn.InputError, match="has messages of /pad whose type mine/msg/Skin cannot be read: "):
        tn.logs.read(log, topic="/pad", field="values", scene=SMALL)
    log = raw_log(tmp_path / "a", "json", [b"{"], ("skin", "jsonschema", b"{}"))
    with pytest.raises(tn.InputError, match="has a message of /pad that is not a skin: "):
        tn.logs.read(log, topic="/pad", field="values", scene=SMALL)


def test_metadata_that_are_not_what_they_say(tmp_path: Path) -> None:
    text, _ = ROS2.generate_msgdef("sensor_msgs/msg/Image", ros_version=2)
    frame = bytes(ROS2.serialize_cdr(image(ROS2, READINGS[0], "64FC1"), "sensor_msgs/msg/Image"))
    good = {"format": "tactile_net.readings", "topic": "/pad", "scene": SMALL.text, "version": "1"}
    for metadata, words in (
        (good, "SHA-256"),
        (good | {"version": "new"}, "is not of the layout that it says it is: ValueError"),
        (
            good | {"scene_sha256": sha256(SMALL.text.encode()).hexdigest()},
            "is not of the layout that it says it is: KeyError",
        ),
    ):
        with open(tmp_path / "a", "wb") as file:
            writer = mcap_writer.Writer(file)
            writer.start()
            writer.add_metadata("tactile_net", metadata)
            channel = writer.register_channel(
                "/pad", "cdr", writer.register_schema("sensor_msgs/msg/Image", "ros2msg", text.encode())
            )
            writer.add_message(channel, 1, frame, 1)
            writer.finish()
        with pytest.raises(tn.InputError, match=words):
            tn.load(tmp_path / "a")


def test_extras_say_how_to_come_by_them(two: tn.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    with pytest.raises(ImportError, match=r"pip install mcap, or tactile-net\[logs\]"):
        two.simulate().save(tmp_path / "x.mcap")
    assert list(tmp_path.iterdir()) == []

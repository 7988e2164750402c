"""Logs of robots: recordings in MCAP, and in bags of ROS 1 and ROS 2. Needs tactile-net[logs]; no ROS.

recording = tn.logs.read("run.mcap", topic="/pad", field="taxels", scene=scene)
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from .._refusal import cut_off, refused
from .._stamps import nanoseconds_of, seconds_of
from ..errors import InputError

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray

    from ._bags import BagLog
    from .._judge import Units
    from ._mcap import McapLog
    from .._recording import Recording, Solution
    from .._scene import Scene

    Log: TypeAlias = BagLog | McapLog

__all__ = ["Message", "blocks", "messages", "read", "write"]


class Message(NamedTuple):
    """Numbers of one message."""

    log_time: int
    """When it was logged [ns]."""
    stamp: int | None
    """Of its header [ns]; None: it has none."""
    values: NDArray[Any]


def read(
    path: str | PathLike[str],
    *,
    topic: str | None = None,
    field: str | None = None,
    scene: Scene | None = None,
    units: Units | None = None,
    missing: bool = True,
) -> Recording:
    """The frames of a topic.

    topic: None: that of `write`, or the only one whose type is known.
    field: where the readings stand in a message: "taxels", "fingers[0].values"; None: as the type says, of
    sensor_msgs/Image (32FC1, 64FC1, mono16; of a skin's channels 32FC3, 64FC3, ...), std_msgs/Float32MultiArray and Float64MultiArray, tactile_msgs/TactileState.
    scene, units, missing: as of `tactile_net.load`.
    Times are the headers' stamps, or else those of the log, of which a note tells. Raises InputError; warns with
    CutOffWarning where the log breaks off, with the number of frames that are whole.
    """
    log = _open(fspath(path))
    topic = _topic(log, topic)
    found = list(_messages(log, topic, field))
    note = [] if log.broken is None else [cut_off(log.where, len(found), log.broken)]
    truth = None
    if topic == log.metadata.get("topic") and "truth_topic" in log.metadata:
        pressed = [one.values for one in _messages(log, log.metadata["truth_topic"], None)][: len(found)]
        found, truth = found[: len(pressed)], np.array(pressed) if pressed else None
    return _recording(log, topic, found, scene, units, missing, note, truth)


def blocks(
    path: str | PathLike[str],
    *,
    frames: int = 4096,
    topic: str | None = None,
    field: str | None = None,
    scene: Scene | None = None,
    units: Units | None = None,
    missing: bool = True,
) -> Iterator[Recording]:
    """The same as recordings of at most so many `frames`, one after another: for logs larger than memory."""
    log = _open(fspath(path))
    topic = _topic(log, topic)
    if scene is not None and "baseline_frames" in scene.to_dict().get("calibration", {}):
        raise ValueError(
            "the baseline is the mean of the first frames, which later blocks do not have: calibration.baseline"
        )
    found = _messages(log, topic, field)
    number = 0
    while block := list(itertools.islice(found, max(frames, 1))):
        number += len(block)
        note = [] if log.broken is None else [cut_off(log.where, number, log.broken)]
        yield _recording(log, topic, block, scene, units, missing, note, None)


def messages(path: str | PathLike[str], *, topic: str | None = None, field: str | None = None) -> Iterator[Message]:
    """The numbers of a topic as they are logged, one message after another: no scene, no units."""
    log = _open(fspath(path))
    number = 0
    for one in _messages(log, _topic(log, topic), field):
        number += 1
        yield one
    if log.broken is not None:
        cut_off(log.where, number, log.broken)


def write(
    path: str | PathLike[str], what: Recording | Solution, *, topic: str = "/pad", dtype: DTypeLike = np.float64
) -> None:
    """An MCAP log that ROS 2 and its viewers read; `read` gives the recording back, times to the nanosecond.

    Readings are sensor_msgs/Image on `topic`: height channels, width taxels, 64FC1 (of float32 32FC1). Tractions are the
    same on topic/tractions, the truth on topic/truth; topic/contact is the force of a Solution as
    geometry_msgs/WrenchStamped: force.x into the pad, force.y along it [N/m], torque.z about its middle [N]. Of a skin the
    images are rows and columns with a channel for each quantity, 64FC3 of three, and of tractions with one for each
    component; the wrench is of the cells that touch, force [N] and torque about the skin's middle [N m] along x, y and z.
    Scene, units and channels are the metadata record "tactile_net".
    Raises ValueError where times are no stamps: not finite, below 0, or beyond 2^31 s.
    """
    from .._files import whole
    from .._layout import layout_of
    from ._log_writer import LogWriter
    from .._recording import Solution

    layout = layout_of(what, dtype)
    frames = len(layout.arrays["readings"])
    stamps = _stamps(what.t)
    attributes = layout.attributes | {"topic": topic, "times": "none" if stamps is None else "s"}
    attributes["channels"] = ",".join(what.scene.channels)
    images = {topic: layout.arrays["readings"]}
    for key in ("truth", "tractions"):
        if key in layout.arrays:
            attributes[f"{key}_topic"] = f"{topic}/{key}"
            images[f"{topic}/{key}"] = _components_last(layout.arrays[key], what.scene)
    times = range(frames) if stamps is None else stamps
    with whole(fspath(path)) as beside, LogWriter(beside, topic.strip("/"), attributes, list(images)) as log:
        wrenches = _wrenches(what) if isinstance(what, Solution) else None
        for k, time in enumerate(times):
            stamp = 0 if stamps is None else time
            for one, values in images.items():
                log.image(one, time, stamp, np.atleast_2d(values[k]))
            if wrenches is not None:
                log.wrench(f"{topic}/contact", time, stamp, *wrenches[k].tolist())


def _stamps(t: NDArray[np.float64] | None) -> list[int] | None:
    from ._numbers import STAMP_LIMIT

    if t is None:
        return None
    bad = np.flatnonzero(~((t >= 0) & (t < STAMP_LIMIT)))
    if bad.size > 0:
        raise ValueError(f"frame {bad[0]} is at {t[bad[0]]:g} s: stamps of logs are from 0 to 2^31 s")
    return nanoseconds_of(t)


def _components_last(tractions: NDArray[Any], scene: Scene) -> NDArray[Any]:
    """A skin's (T, U, rows, columns) as images have them; a line's as they are."""
    return tractions if len(scene.traction_shape) == 1 else np.moveaxis(tractions, 1, -1)


def _wrenches(solution: Solution) -> NDArray[np.float64]:
    """(T, 6): force and torque about the middle of the array; x runs into the pad, y along it, of skins z across.

    Of line arrays [N/m] and [N]. Where drags are not solved for they are 0.
    """
    from .._skin_solution import SkinSolution

    count = len(solution)
    pressed = solution.tractions
    if not isinstance(solution, SkinSolution):
        spacing = solution.scene.spacing
        none = np.zeros(count)
        drag = none if pressed.shape[1] == 1 else solution.tangential_force
        moment = -spacing * (pressed[:, 0] * solution.y).sum(axis=1)
        return np.stack([solution.normal_force, drag, none, none, none, moment], axis=1)
    touching = solution.touching
    alone = touching | ~touching.any(axis=(1, 2), keepdims=True)  # all cells where none is certain to touch
    forces = np.zeros((count, 3, *solution.scene.traction_shape))
    forces[:, : pressed.shape[1]] = solution.scene.cell_area * np.where(alone[:, None], pressed, 0.0)
    y, z = solution.y[:, None], solution.z
    p, q_y, q_z = forces[:, 0], forces[:, 1], forces[:, 2]
    moments = [y * q_z - z * q_y, z * p, -y * p]
    return np.stack([values.sum(axis=(1, 2)) for values in (p, q_y, q_z, *moments)], axis=1)


def _open(where: str) -> Log:
    """By content; a folder is a bag of ROS 2, finished or not."""
    from ._bags import BagLog
    from ._mcap import MAGIC, McapLog

    if os.path.isdir(where):
        inside = sorted(os.path.join(where, one) for one in os.listdir(where))
        recorded, tables = ([one for one in inside if one.endswith(form)] for form in (".mcap", ".db3"))
        closed = os.path.exists(os.path.join(where, "metadata.yaml"))
        return McapLog(where, recorded) if recorded else BagLog(where, [where] if closed or not tables else tables)
    with open(where, "rb") as file:
        start = file.read(16)
    if start.startswith(MAGIC):
        return McapLog(where, [where])
    if start.startswith((b"#ROSBAG V2.0\n", b"SQLite format 3")):
        return BagLog(where, [where])
    raise refused(where, "is empty" if not start else "is neither MCAP nor a ROS bag")


def _topic(log: Log, topic: str | None) -> str:
    from ._numbers import PRESETS, plain_type

    there = ", ".join(f"{name} ({kind})" for name, kind in sorted(log.topics.items())) or "none"
    if topic is not None:
        if topic not in log.topics:
            raise refused(log.where, f"has no topic {topic!r}; topics: {there}", "topic= one of them")
        return topic
    known = [name for name, kind in log.topics.items() if plain_type(kind) in PRESETS]
    if log.metadata.get("topic") in log.topics:
        return log.metadata["topic"]
    if len(known) == 1:
        return known[0]
    raise refused(
        log.where, f"does not say which topic has the readings; topics: {there}", "topic= one of them, and field="
    )


def _messages(log: Log, topic: str, field: str | None) -> Iterator[Message]:
    from ._numbers import reader, stamp

    size = None
    try:
        of = reader(log.topics[topic], field)
    except ValueError as error:
        raise refused(log.where, f"{topic} {error}", "field= says where in a message they stand") from None
    for number, (time, message) in enumerate(log.messages(topic)):
        try:
            values = of(message)
        except ValueError as error:
            raise refused(log.where, f"frame {number} of {topic} {error}") from None
        size = values.size if size is None else size
        if values.size != size:
            raise refused(
                log.where,
                f"frame {number} of {topic} has {values.size} readings, those before it have {size}",
                "each sensor needs a topic of its own",
            )
        yield Message(time, stamp(message), values)


def _recording(
    log: Log,
    topic: str,
    found: list[Message],
    scene: Scene | None,
    units: Units | None,
    missing: bool,
    notes: list[str],
    truth: NDArray[Any] | None,
) -> Recording:
    from .._judge import as_it_says, judged
    from .._layout import Layout, scene_in

    own = topic == log.metadata.get("topic")
    if topic in (log.metadata.get("tractions_topic"), log.metadata.get("truth_topic")):
        raise refused(
            log.where, f"{topic} has tractions, not readings", f"tactile_net.logs.messages(path, topic={topic!r})"
        )
    if scene is None and log.metadata:
        with as_it_says(log.where):
            scene = scene_in(Layout({}, log.metadata), log.where)
    if scene is not None and not found:
        values = np.zeros((0, *scene.reading_shape))
    else:
        values = np.array([one.values for one in found])
    if scene is not None and values.shape[1:2] == (1,) and not scene.even:
        values = values[:, 0]
    if scene is not None and (*values.shape[1:], 1) == scene.reading_shape:  # a skin's image of one channel
        values = values[..., np.newaxis]
    t, order, more = _times(found, own)
    layout = Layout({"readings": values[order]}, log.metadata if own else {}, notes=[*notes, *more], seconds=True)
    if not own or log.metadata.get("times") != "none":
        layout.arrays["t"] = t
    if truth is not None:
        of_skin = scene is not None and len(scene.traction_shape) > 1 and truth.ndim == 4
        layout.arrays["truth"] = np.moveaxis(truth[order], -1, 1) if of_skin else truth[order]
    try:
        return judged(layout, log.where, scene, units, missing)
    except InputError as error:
        raise InputError(str(error).replace(": error: ", f": error: {topic} ", 1), error.diagnostics) from None


def _times(found: list[Message], own: bool) -> tuple[NDArray[np.float64], NDArray[np.int_], list[str]]:
    """Times [s], the order of the frames, and what is to be said of them. own: stamps are those that `write` gave."""
    logged = np.array([one.log_time for one in found], dtype=np.int64)
    order = np.arange(len(found))
    stamps = [one.stamp for one in found if one.stamp is not None]
    notes = []
    if len(stamps) == len(found) and (own or any(stamps)):
        back = np.flatnonzero(np.diff(np.array(stamps, dtype=np.int64)) < 0)
        if back.size == 0:
            return seconds_of(stamps), order, []
        notes = [f"stamps go back at frame {back[0] + 1}: times are those of the log"]
    elif stamps:
        notes = ["all stamps are 0: times are those of the log"]
    if (np.diff(logged) < 0).any():
        order = np.argsort(logged, kind="stable")
        notes.append("frames were not logged in the order of their times: they are sorted")
    return seconds_of(logged[order]), order, notes

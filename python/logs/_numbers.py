"""Numbers of a message: by the path of a field, or as its type says."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_ENCODINGS = {"32FC": "f4", "64FC": "f8", "mono16": "u2", "16UC": "u2", "mono8": "u1", "8UC": "u1"}
"""Those in C are followed by how many channels there are."""
STAMP_LIMIT = 2**31  # seconds are 32 bits in ROS


def _image(message: Any) -> NDArray[Any]:
    """(height, width): channels, taxels; of several channels (height, width, channels): those of a skin."""
    named = re.fullmatch(r"(\d+[FU]C)([1-9]\d{0,3})", message.encoding)
    kind, channels = (named[1], int(named[2])) if named else (message.encoding, 1)
    if kind not in _ENCODINGS or (named is None and kind.endswith("C")):
        raise ValueError(
            f"is an image in {message.encoding!r}; readable are 32FC1, 64FC1, mono16, 16UC1, mono8, 8UC1, and these "
            "with more channels"
        )
    order = ">" if message.is_bigendian else "<"
    dtype = np.dtype(order + _ENCODINGS[kind])
    data = np.asarray(message.data, dtype=np.uint8)
    used = message.width * channels * dtype.itemsize
    if message.step < used or data.size != message.height * message.step:
        raise ValueError(
            f"is an image of {data.size} bytes, not {message.height} rows of {max(message.step, used)}: it is broken"
        )
    rows = np.ascontiguousarray(data.reshape(message.height, message.step)[:, :used])
    values = rows.view(dtype)
    return values if channels == 1 else values.reshape(message.height, message.width, channels)


def _multi_array(message: Any) -> NDArray[Any]:
    return np.asarray(message.data)[message.layout.data_offset :]


def _tactile_state(message: Any) -> NDArray[Any]:
    return np.concatenate([np.asarray(sensor.values) for sensor in message.sensors] or [np.zeros(0)])


PRESETS: dict[str, Callable[[Any], NDArray[Any]]] = {
    "sensor_msgs/Image": _image,
    "std_msgs/Float32MultiArray": _multi_array,
    "std_msgs/Float64MultiArray": _multi_array,
    "tactile_msgs/TactileState": _tactile_state,
}
"""By the type of a message, as ROS 1 writes it."""


def plain_type(name: str) -> str:
    """ "sensor_msgs/msg/Image" is ROS 2's name of "sensor_msgs/Image"."""
    return name.replace("/msg/", "/")


def reader(kind: str, field: str | None) -> Callable[[Any], NDArray[Any]]:
    """Raises ValueError where the type is none that is known, and no field was named."""
    if field is not None:
        return lambda message: at(message, field)
    if plain_type(kind) in PRESETS:
        return PRESETS[plain_type(kind)]
    raise ValueError(f"holds {kind}; without field= are read: {', '.join(PRESETS)}")


def at(message: Any, path: str) -> NDArray[Any]:
    """The numbers under a path such as "taxels" or "fingers[0].values"; a list of messages gives all of theirs."""
    value = message
    for step in re.findall(r"[^.\[\]]+", path):
        value = _within(value, step, path)
    return _flat(value, path)


def _within(value: Any, step: str, path: str) -> Any:
    if _is_list(value):
        if not step.isdecimal():
            return [_within(one, step, path) for one in value]
        if int(step) < len(value):
            return value[int(step)]
        raise ValueError(f"has no number {step} of {len(value)} in {path!r}")
    known = fields(value)
    if step not in known:
        raise ValueError(f"has no field {step!r} of {path!r}; there are {', '.join(known) or 'none'}")
    return value[step] if isinstance(value, Mapping) else getattr(value, step)


def _flat(value: Any, path: str) -> NDArray[Any]:
    if _is_list(value) and any(_is_list(one) for one in value):
        value = np.concatenate([np.asarray(_flat(one, path)).reshape(-1) for one in value])
    array: NDArray[Any] = np.asarray(value)
    if array.dtype.kind not in "fiu":
        inside = fields(value[0] if _is_list(value) and len(value) > 0 else value)
        more = f"; it has {', '.join(inside)}" if inside else ""
        raise ValueError(f"has no numbers in {path!r}{more}")
    return array


def fields(value: Any) -> list[str]:
    if isinstance(value, Mapping):
        return [str(key) for key in value]
    return [name for name in getattr(value, "__dataclass_fields__", {}) if name != "__msgtype__"]


def _is_list(value: Any) -> bool:
    return isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes))


def stamp(message: Any) -> int | None:
    """Of the header [ns]; None: the message has none."""
    header = message.get("header") if isinstance(message, Mapping) else getattr(message, "header", None)
    when = header.get("stamp") if isinstance(header, Mapping) else getattr(header, "stamp", None)
    if when is None or isinstance(when, Mapping):
        return None if when is None else int(when.get("sec", 0)) * 10**9 + int(when.get("nanosec", when.get("nsec", 0)))
    return int(when.sec) * 10**9 + int(when.nanosec)

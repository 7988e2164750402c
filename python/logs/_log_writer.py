"""Messages of ROS 2 into an MCAP file."""

from __future__ import annotations

from types import TracebackType
from typing import Any

import numpy as np

from .._optional import optional

_IMAGE, _WRENCH = "sensor_msgs/msg/Image", "geometry_msgs/msg/WrenchStamped"
_ENCODINGS = {"f4": "32FC", "f8": "64FC"}


class LogWriter:
    """A log that stands when the block ends; the metadata come first, so that what a crash leaves has them."""

    def __init__(self, path: str, frame: str, attributes: dict[str, str], images: list[str]) -> None:
        typesys = optional("rosbags.typesys", "logs")
        writer = optional("mcap.writer", "logs")
        self._store = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
        self._type = {name: self._store.types[name] for name in (_IMAGE, _WRENCH)}
        self._frame = frame
        self._channels: dict[str, int] = {}
        self._file = open(path, "wb")
        self._writer = writer.Writer(self._file)
        self._writer.start(profile="ros2", library="tactile-net")
        self._writer.add_metadata("tactile_net", attributes)
        for topic in images:  # of a recording without frames too
            self._channel(topic, _IMAGE)

    def image(self, topic: str, time: int, stamp: int, values: Any) -> None:
        """values: (height, width) or (height, width, channels), float32 or float64."""
        height, width, channels = (*values.shape, 1)[:3]
        data = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<")).view(np.uint8).reshape(-1)
        encoding = f"{_ENCODINGS[values.dtype.str[1:]]}{channels}"
        step = width * channels * values.dtype.itemsize
        message = self._type[_IMAGE](self._header(stamp), height, width, encoding, 0, step, data)
        self._add(topic, _IMAGE, time, message)

    def wrench(self, topic: str, time: int, stamp: int, *values: float) -> None:
        """values: force along x, y, z, then torque."""
        vector, wrench = (self._store.types[f"geometry_msgs/msg/{name}"] for name in ("Vector3", "Wrench"))
        both = wrench(vector(*values[:3]), vector(*values[3:]))
        self._add(topic, _WRENCH, time, self._type[_WRENCH](self._header(stamp), both))

    def _header(self, stamp: int) -> Any:
        types = self._store.types
        return types["std_msgs/msg/Header"](types["builtin_interfaces/msg/Time"](*divmod(stamp, 10**9)), self._frame)

    def _channel(self, topic: str, kind: str) -> int:
        if topic not in self._channels:
            text, _ = self._store.generate_msgdef(kind, ros_version=2)
            schema = self._writer.register_schema(kind, "ros2msg", text.encode())
            self._channels[topic] = self._writer.register_channel(topic, "cdr", schema)
        return self._channels[topic]

    def _add(self, topic: str, kind: str, time: int, message: Any) -> None:
        data = bytes(self._store.serialize_cdr(message, kind))
        self._writer.add_message(self._channel(topic, kind), time, data, time)

    def __enter__(self) -> LogWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self._writer.finish()
        self._file.close()

"""Bags of ROS 1, and those of ROS 2 that are SQLite."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from ._optional import optional
from ._refusal import refused


class BagLog:
    """As McapLog; what is of an unfinished bag only its own tools can tell."""

    def __init__(self, where: str) -> None:
        self.where = where
        self.broken: str | None = None
        self.metadata: dict[str, str] = {}
        with self._open() as reader:
            self.topics = {one.topic: one.msgtype for one in reader.connections}

    @contextmanager
    def _open(self) -> Iterator[Any]:
        highlevel = optional("rosbags.highlevel", "logs")
        typesys = optional("rosbags.typesys", "logs")
        with ExitStack() as stack:
            path = Path(self.where)
            if path.is_file():  # the library knows by the name what it is
                with path.open("rb") as file:
                    wanted = ".bag" if file.read(8) == b"#ROSBAG " else ".db3"
                if path.suffix != wanted:
                    folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
                    path = folder / f"log{wanted}"
                    path.symlink_to(Path(self.where).resolve())
            known = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
            try:
                reader = stack.enter_context(highlevel.AnyReader([path], default_typestore=known))
            except Exception as error:  # a damaged bag: the library raises what the bytes make it raise
                raise refused(
                    self.where,
                    f"is no whole bag: {str(error) or type(error).__name__}",
                    "rosbag reindex (ROS 1) or ros2 bag reindex mend bags that were not closed",
                ) from None
            yield reader

    def messages(self, topic: str) -> Iterator[tuple[int, Any]]:
        self.broken = None
        with self._open() as reader:
            connections = [one for one in reader.connections if one.topic == topic]
            items = reader.messages(connections=connections)
            while True:
                try:
                    connection, time, data = next(items)
                    message = reader.deserialize(data, connection.msgtype)
                except StopIteration:
                    return
                except Exception as error:  # as above
                    self.broken = str(error) or type(error).__name__
                    return
                yield time, message

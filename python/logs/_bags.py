"""Bags of ROS 1, and those of ROS 2 that are SQLite."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from .._optional import optional
from .._refusal import refused


class BagLog:
    """As McapLog: one file or folder, or several files of SQLite."""

    def __init__(self, where: str, files: list[str]) -> None:
        self.where = where
        self._files = files
        self.broken: str | None = None
        self.metadata: dict[str, str] = {}
        with self._open() as reader:
            self.topics = {one.topic: one.msgtype for one in reader.connections}

    @contextmanager
    def _open(self) -> Iterator[Any]:
        highlevel = optional("rosbags.highlevel", "logs")
        typesys = optional("rosbags.typesys", "logs")
        with ExitStack() as stack:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            paths = [_well_named(Path(file), folder) for file in self._files]
            known = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
            try:
                reader = stack.enter_context(highlevel.AnyReader(paths, default_typestore=known))
            except Exception as error:  # a damaged bag: the library raises what the bytes make it raise
                raise refused(
                    self.where,
                    f"is not a whole bag: {str(error) or type(error).__name__}",
                    f"reindex first: rosbag reindex {self.where}, or of ROS 2 ros2 bag reindex on its folder",
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


def _well_named(path: Path, folder: Path) -> Path:
    """The library knows by its name what a file is; under another it is a link in `folder`."""
    if path.is_dir():
        return path
    with path.open("rb") as file:
        suffix = ".bag" if file.read(8) == b"#ROSBAG " else ".db3"
    if path.suffix == suffix:
        return path
    link = folder / f"{path.name}{suffix}"
    link.symlink_to(path.resolve())
    return link

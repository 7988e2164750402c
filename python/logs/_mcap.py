"""MCAP, whole or cut off by a crash: messages one after another, so that a log of any length takes constant memory."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import Any

from ._decoding import decoder
from .._optional import optional

MAGIC = b"\x89MCAP0\r\n"


class McapLog:
    """One .mcap, or several of a ROS 2 bag."""

    def __init__(self, where: str, files: list[str]) -> None:
        self.where = where
        self.broken: str | None = None
        """Why the last iteration ended before the log."""
        self.topics: dict[str, str] = {}
        """Their types."""
        self.metadata: dict[str, str] = {}
        """Our record's."""
        self._files = files
        self._records = optional("mcap.records", "logs")
        for file in files:
            self._look(file)

    def _look(self, path: str) -> None:
        schemas: dict[int, str] = {}
        for record in self._contents(path):
            if isinstance(record, self._records.Schema):
                schemas[record.id] = record.name
            elif isinstance(record, self._records.Channel):
                self.topics[record.topic] = schemas.get(record.schema_id, record.message_encoding)
            elif isinstance(record, self._records.Metadata) and record.name == "tactile_net":
                self.metadata = dict(record.metadata)

    def _contents(self, path: str) -> Iterator[Any]:
        """Records without messages: of a whole log those of its summary, else all that there are."""
        reader = optional("mcap.reader", "logs")
        with open(path, "rb") as file:
            if _is_whole(path):
                try:
                    seeking = reader.SeekingReader(file)
                    summary = seeking.get_summary()
                    found = [*summary.schemas.values(), *summary.channels.values(), *seeking.iter_metadata()]
                except Exception:  # no summary, or a damaged one: the library raises what the bytes make it raise
                    found = []
                if found:
                    yield from found
                    return
            file.seek(0)
            yield from self._until_broken(optional("mcap.stream_reader", "logs").StreamReader(file).records)

    def messages(self, topic: str) -> Iterator[tuple[int, Any]]:
        """Log time [ns] and message, in the order of the file."""
        for path in self._files:
            decode: Callable[[bytes], Any] | None = None
            for schema, channel, message in self._of(path, topic):
                if decode is None:
                    kind, form, text = ("", "", b"") if schema is None else (schema.name, schema.encoding, schema.data)
                    decode = decoder(self.where, topic, channel.message_encoding, kind, form, text)
                yield message.log_time, decode(message.data)
            if self.broken is not None:
                return

    def _of(self, path: str, topic: str) -> Iterator[tuple[Any, Any, Any]]:
        """By the index of a whole log, which skips what is of other topics; else as the file goes on."""
        reader = optional("mcap.reader", "logs")
        self.broken = None
        with open(path, "rb") as file:
            indexed = _is_whole(path) and self._indexed(file)
            file.seek(0)
            opened = (reader.SeekingReader if indexed else reader.NonSeekingReader)(file, validate_crcs=True)
            # In the order of time the library holds a chunk at a time; in that of the file, by an index, all of them.
            yield from self._until_broken(opened.iter_messages(topics=[topic], log_time_order=indexed))

    def _indexed(self, file: Any) -> bool:
        try:
            summary = optional("mcap.reader", "logs").SeekingReader(file).get_summary()
        except Exception:  # as above
            return False
        return summary is not None and len(summary.chunk_indexes) > 0

    def _until_broken(self, items: Iterator[Any]) -> Iterator[Any]:
        try:
            yield from items
        except Exception as error:  # as above
            ended = optional("mcap.exceptions", "logs").EndOfFile
            self.broken = "the end of the file" if isinstance(error, ended) else str(error) or type(error).__name__


def _is_whole(path: str) -> bool:
    with open(path, "rb") as file:
        file.seek(max(os.path.getsize(path) - len(MAGIC), 0))
        return os.path.getsize(path) > len(MAGIC) and file.read() == MAGIC

"""What is whole of a bag of ROS 1 that was never closed, or cut: its index is missing, most of its chunks are not."""

from __future__ import annotations

import bz2
import io
import struct
from collections.abc import Callable, Iterator
from typing import IO, Any

from ._decoding import decoder
from ._optional import optional

_MESSAGE, _CHUNK, _CONNECTION = 2, 5, 7
_Record = tuple[dict[str, bytes], bytes]


class TornBag:
    """As McapLog: records one after another, up to where the file breaks off."""

    def __init__(self, where: str) -> None:
        self.where = where
        self.broken: str | None = None
        self.metadata: dict[str, str] = {}
        self.topics: dict[str, str] = {}
        for head, data in self._records():
            if head["op"][0] == _CONNECTION:
                self.topics[head["topic"].decode()] = _fields(data)["type"].decode()

    def messages(self, topic: str) -> Iterator[tuple[int, Any]]:
        decoders: dict[bytes, Callable[[bytes], Any]] = {}
        for head, data in self._records():
            if head["op"][0] == _CONNECTION and head["topic"].decode() == topic:
                told = _fields(data)
                kind = told["type"].decode()
                decoders[head["conn"]] = decoder(self.where, topic, "ros1", kind, "ros1msg", told["message_definition"])
            elif head["op"][0] == _MESSAGE and head["conn"] in decoders:
                seconds, nanoseconds = struct.unpack("<II", head["time"])
                yield seconds * 10**9 + nanoseconds, decoders[head["conn"]](data)

    def _records(self) -> Iterator[_Record]:
        unpack = {b"none": bytes, b"bz2": bz2.decompress, b"lz4": optional("lz4.frame", "logs").decompress}
        with open(self.where, "rb") as file:
            file.readline()  # "#ROSBAG V2.0"
            while True:
                try:
                    head, data = _record(file)
                    inside = [(head, data)]
                    if head["op"][0] == _CHUNK:
                        inside = list(_all(io.BytesIO(unpack[head["compression"]](data))))
                except Exception as error:  # the bytes may be anything
                    self.broken = str(error) or type(error).__name__
                    return
                yield from inside


def _all(file: IO[bytes]) -> Iterator[_Record]:
    while file.read(1):
        file.seek(-1, io.SEEK_CUR)
        yield _record(file)


def _record(file: IO[bytes]) -> _Record:
    return _fields(_block(file)), _block(file)


def _block(file: IO[bytes]) -> bytes:
    """Its length, and as many bytes."""
    start = file.read(4)
    size = struct.unpack("<I", start)[0] if len(start) == 4 else 0
    data = file.read(size)
    if len(start) < 4 or len(data) < size:
        raise EOFError("the end of the file, before its index")
    return data


def _fields(data: bytes) -> dict[str, bytes]:
    file = io.BytesIO(data)
    found = {}
    while file.tell() < len(data):
        name, _, value = _block(file).partition(b"=")
        found[name.decode()] = value
    return found

"""FlatBuffers read by the schema that stands beside them: arrays of structs by the names of their fields.

Every offset is checked against the buffer, so that a broken or a hostile one is refused, not followed."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .._arrays import Floats

_NUMBERS = {"b": 1, "B": 1, "h": 2, "H": 2, "i": 4, "I": 4, "q": 8, "Q": 8, "f": 4, "d": 8}
_FLOAT, _DOUBLE, _VECTOR, _TABLE, _UNION = 11, 12, 14, 15, 16
_WIDTH = {_FLOAT: "<f4", _DOUBLE: "<f8"}


class Field(NamedTuple):
    name: str
    base: int
    element: int
    kind: int
    offset: int


class Kind(NamedTuple):
    """A table or a struct of the schema."""

    name: str
    fields: tuple[Field, ...]
    is_struct: bool
    size: int


class Buffer:
    """Bytes of tables. Raises ValueError where an offset leads out of them."""

    def __init__(self, data: bytes) -> None:
        self.data = data

    def number(self, form: str, at: int) -> int:
        if not 0 <= at <= len(self.data) - _NUMBERS[form]:
            raise ValueError("an offset leads out of the message")
        return int(struct.unpack_from(f"<{form}", self.data, at)[0])

    def root(self) -> int:
        return self.number("I", 0)

    def field(self, table: int, offset: int) -> int | None:
        """Where a table's field stands; None: it has its default."""
        vtable = table - self.number("i", table)
        if offset + 2 > self.number("H", vtable):
            return None
        relative = self.number("H", vtable + offset)
        return table + relative if relative else None

    def followed(self, at: int) -> int:
        return at + self.number("I", at)

    def vector(self, at: int, width: int) -> tuple[int, int]:
        """Where the elements begin, and how many there are."""
        start = self.followed(at)
        count = self.number("I", start)
        if start + 4 + count * width > len(self.data):
            raise ValueError("a vector leads out of the message")
        return start + 4, count

    def text(self, at: int) -> str:
        start, count = self.vector(at, 1)
        return self.data[start : start + count].decode()


class Schema:
    """A binary schema (.bfbs), as flatc writes it and MCAP holds it."""

    def __init__(self, data: bytes) -> None:
        if data[4:8] != b"BFBS":
            raise ValueError("the schema is not a binary one of FlatBuffers")
        buffer = Buffer(data)
        self._buffer = buffer
        root = buffer.root()
        self.kinds = [self._kind(one) for one in self._tables(root, 4)]
        self.unions = [dict(map(self._member, self._tables(one, 6))) for one in self._tables(root, 6)]
        table = buffer.field(root, 12)
        if table is None:
            raise ValueError("the schema has no root")
        name = self._kind(buffer.followed(table)).name
        self.root = next((one for one in self.kinds if one.name == name), Kind(name, (), False, 0))

    def _tables(self, table: int, offset: int) -> list[int]:
        """Where the tables of a vector of them stand."""
        buffer = self._buffer
        at = buffer.field(table, offset)
        start, count = buffer.vector(at, 4) if at is not None else (0, 0)
        return [buffer.followed(start + 4 * k) for k in range(count)]

    def _member(self, table: int) -> tuple[int, int]:
        """Of an enumerator its value, and of a union's the table that it means; -1: none."""
        value, kind = (self._buffer.field(table, offset) for offset in (6, 10))
        of = -1 if kind is None else self._type(kind)[2]
        return 0 if value is None else self._buffer.number("q", value), of

    def _type(self, at: int | None) -> tuple[int, int, int]:
        """Base, element and index."""
        numbers = [0, 0, -1]
        if at is not None:
            table = self._buffer.followed(at)
            for k, (form, offset) in enumerate((("b", 4), ("b", 6), ("i", 8))):
                place = self._buffer.field(table, offset)
                numbers[k] = numbers[k] if place is None else self._buffer.number(form, place)
        return numbers[0], numbers[1], numbers[2]

    def _kind(self, table: int) -> Kind:
        buffer = self._buffer
        name, is_struct, size = (buffer.field(table, offset) for offset in (4, 8, 12))
        return Kind(
            "" if name is None else buffer.text(name),
            tuple(map(self._field, self._tables(table, 6))),
            is_struct is not None and bool(buffer.number("B", is_struct)),
            0 if size is None else buffer.number("i", size),
        )

    def _field(self, table: int) -> Field:
        buffer = self._buffer
        name, kind, offset = (buffer.field(table, one) for one in (4, 6, 10))
        base, element, index = self._type(kind)
        called = "" if name is None else buffer.text(name)
        return Field(called, base, element, index, 0 if offset is None else buffer.number("H", offset))

    def columns(self, kind: Kind, before: str = "", base: int = 0, deep: int = 0) -> Iterator[tuple[str, int, str]]:
        """Of a struct every floating-point number in it: path, where it stands, NumPy's type."""
        for field in kind.fields:
            path = f"{before}{field.name}"
            if field.base in _WIDTH:
                yield path, base + field.offset, _WIDTH[field.base]
            elif field.base == _TABLE and 0 <= field.kind < len(self.kinds) and deep < 4:
                yield from self.columns(self.kinds[field.kind], f"{path}.", base + field.offset, deep + 1)

    def arrays(self, message: bytes) -> dict[str, dict[str, Floats]]:
        """Every vector of structs in a message, by its path: its columns by theirs. Raises ValueError for a broken message."""
        buffer = Buffer(message)
        return dict(self._arrays(buffer, buffer.root(), self.root, "", 0))

    def _arrays(
        self, buffer: Buffer, table: int, kind: Kind, before: str, deep: int
    ) -> Iterator[tuple[str, dict[str, Floats]]]:
        for field in kind.fields if deep < 8 else ():
            at = buffer.field(table, field.offset)
            index = field.kind if field.base != _UNION else self._chosen(buffer, table, field)
            if at is None or not 0 <= index < len(self.kinds):
                continue
            inner, path = self.kinds[index], f"{before}{field.name}"
            if field.base in (_TABLE, _UNION) and not inner.is_struct:
                yield from self._arrays(buffer, buffer.followed(at), inner, f"{path}.", deep + 1)
            elif field.base == _VECTOR and field.element == _TABLE and inner.is_struct and inner.size > 0:
                start, count = buffer.vector(at, inner.size)
                names, offsets, types = zip(*self.columns(inner), strict=True) if inner.fields else ((), (), ())
                form = np.dtype({"names": names, "offsets": offsets, "formats": types, "itemsize": inner.size})
                rows = np.frombuffer(buffer.data, form, count, start)
                yield path, {name: rows[name].astype(np.float64) for name in names}

    def _chosen(self, buffer: Buffer, table: int, field: Field) -> int:
        """Which table a union is: by the number in the field before it."""
        tag = buffer.field(table, field.offset - 2) if field.offset >= 6 else None
        known = self.unions[field.kind] if 0 <= field.kind < len(self.unions) else {}
        return -1 if tag is None else known.get(buffer.number("B", tag), -1)

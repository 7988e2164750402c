"""Parquet: a frame a row; arrays as lists of fixed size, shapes and attributes in the schema's metadata."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from ._containers import beside, chosen
from ._layout import OF_FRAMES, Layout
from ._optional import optional
from ._refusal import refused

KEY = b"tactile_net"


def column(name: str) -> str:
    """What a column of readings is called: the one place that knows LeRobot's convention."""
    return f"observation.tactile.{name}"


def write(path: str, layout: Layout, name: str) -> None:
    pyarrow = optional("pyarrow", "tables")
    parquet = optional("pyarrow.parquet", "tables")
    columns = {}
    shapes = {}
    for key in OF_FRAMES:
        if key not in layout.arrays:
            continue
        values = layout.arrays[key]
        shapes[key] = values.shape[1:]
        flat = pyarrow.array(values.reshape(-1).tolist() if values.dtype.kind == "U" else values.reshape(-1))
        one = int(np.prod(values.shape[1:]))
        called = column(name) if key == "readings" else key
        columns[called] = flat if values.ndim == 1 else pyarrow.FixedSizeListArray.from_arrays(flat, one)
    told = {
        "attributes": layout.attributes,
        "name": name,
        "shapes": shapes,
        "channels": layout.arrays["channels"].tolist(),
    } | {axis: layout.arrays[axis].tolist() for axis in ("y", "z") if axis in layout.arrays}
    table = pyarrow.table(columns).replace_schema_metadata({KEY: json.dumps(told)})
    parquet.write_table(table, path, compression="zstd")


def read(path: str, name: str | None) -> Layout:
    pyarrow = optional("pyarrow", "tables")
    parquet = optional("pyarrow.parquet", "tables")
    try:
        table = parquet.read_table(path)
    except (pyarrow.ArrowException, OSError) as error:
        first = str(error).partition("\n")[0]
        raise refused(
            path,
            f"is not a whole Parquet file: {first}",
            "its table stands at its end, so that nothing of a part can be read",
        ) from None
    metadata = table.schema.metadata or {}
    if KEY not in metadata:
        return _foreign(path, table, name)
    told = json.loads(metadata[KEY])
    arrays = {axis: np.array(told[axis]) for axis in ("channels", "y", "z") if axis in told}
    for key, shape in told["shapes"].items():
        called = column(told["name"]) if key == "readings" else key
        arrays[key] = _rows(table[called]).reshape(len(table), *shape)
    return Layout(arrays, told["attributes"])


def _rows(chunked: Any) -> Any:
    """A column as an array of all its numbers, or of its texts."""
    combined = chunked.combine_chunks()
    flat = combined.flatten() if "list" in str(combined.type) else combined
    if flat.null_count > 0 and "float" not in str(flat.type) and "double" not in str(flat.type):
        flat = flat.cast("float64")
    return np.asarray(flat.to_numpy(zero_copy_only=False))


def _foreign(path: str, table: Any, name: str | None) -> Layout:
    """A list a row under one name, or a number a column under names that end in numbers: as one writes a DataFrame."""
    named: dict[str, Any] = {}
    for key in table.column_names:
        values = _rows(table[key])
        if values.dtype.kind in "fiuM":
            lists = "list" in str(table[key].type)
            if lists and values.size % max(len(table), 1) != 0:
                raise refused(
                    path, f"has lists of different lengths in {key!r}", "a frame has as many readings in each row"
                )
            named[key] = values.reshape(len(table), -1) if lists else values
    columns = None
    wide = {key: values for key, values in named.items() if key[-1:].isdecimal() and values.ndim == 1}
    if name is None and wide and not any(values.ndim == 2 for values in named.values()):
        columns = list(wide)
        named = {key: values for key, values in named.items() if key not in wide}
        named["readings"] = np.stack(list(wide.values()), axis=1)
    key = chosen(path, named, name, "column")
    at = beside(named, key)
    unit = (table.schema.field(key).metadata or {}).get(b"units") if key in table.column_names else None
    held = {"readings": named[key]} | ({} if at is None else {"t": named[at]})
    return Layout(held, units=None if unit is None else unit.decode(), columns=columns)

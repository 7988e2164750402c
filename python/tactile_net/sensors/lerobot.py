"""LeRobot: a feature of shape (points, 3) or (points, 6), [dx dy dz Fx Fy Fz], in a data set of version 3, or in one Parquet.

Neither units nor places are in it: `units=` and `geometry=` say them. Of both displacements and forces the displacements are
read, unless reads="force"."""

from __future__ import annotations

import glob
import json
import os
from typing import Any

from numpy.typing import NDArray

from .._geometry import Frames, Geometry
from .._optional import optional
from .._refusal import refused
from . import Given
from ._reading import MOST_BYTES, in_si, one_of, start_of

name = "lerobot"
refusal = ""
_DISPLACEMENT, _FORCE = ("dx", "dy", "dz"), ("fx", "fy", "fz")


def sniff(path: str) -> float:
    """A folder with meta/info.json of tactile features; a Parquet that has such a column."""
    if os.path.isdir(path):
        return 0.9 if any(_is_tactile(key, one) for key, one in _features(path).items()) else 0.0
    if start_of(path, 4) != b"PAR1":
        return 0.0
    try:
        schema = optional("pyarrow.parquet", "tables").read_schema(path)
    except Exception:  # whatever a broken file makes of it: then it is none
        return 0.0
    return 0.8 if any("tactile" in key for key in schema.names) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """None is in the format."""
    raise refused(
        path, "has no places of its points: LeRobot's format holds none", "geometry= a tn.Geometry, or its CSV"
    )


def frames(path: str, given: Given) -> Frames:
    """Of one episode; name="FEATURE@EPISODE" says which."""
    feature, _, episode = (given.name or "").partition("@")
    table, key = _table(path, feature or None)
    told = _features(path).get(key, {}).get("names") if os.path.isdir(path) else None
    names = told or (table.schema.field(key).metadata or {}).get(b"names", b"").decode().split()
    if "episode_index" in table.schema.names:
        numbers = table["episode_index"].to_numpy()
        chosen = one_of(path, map(str, dict.fromkeys(numbers.tolist())), episode or None, "episode")
        table = table.filter(numbers == int(chosen))
    values = _values(path, key, table[key].combine_chunks(), _features(path).get(key, {}).get("shape"))
    kind, components = _components(path, values.shape[2], [str(one).lower() for one in names or ()], given)
    t = table["timestamp"].to_numpy().astype(float) if "timestamp" in table.schema.names else None
    unit = "m" if kind == "displacement" else "N"
    axes = given.frame or "sensor"
    notes = () if given.frame else ("components are taken along the sensor's axes: frame=",)
    return Frames(in_si(path, values[:, :, components], given, kind), t, unit, axes, notes=notes, file=path)


def _components(path: str, count: int, names: list[str], given: Given) -> tuple[str, list[int]]:
    """What is read, and which of a point's numbers it is."""
    if given.reads not in (None, "displacement", "force"):
        raise refused(path, f"holds displacements or forces, and reads={given.reads!r} was asked for")
    if any(one.startswith(("t", "m")) and one[1:] in ("x", "y", "z") for one in names):
        raise refused(
            path, "is a wrench, a force and a torque of the whole sensor", "there is nothing to find: it is the answer"
        )
    named = {
        kind: [names.index(one) for one in known]
        for kind, known in (("displacement", _DISPLACEMENT), ("force", _FORCE))
        if set(known) <= set(names)
    }
    if named and len(names) == count:
        kind = given.reads or next(iter(named))
        if kind not in named:
            raise refused(path, f"has no {kind}s: {', '.join(names)}")
        return kind, named[kind]
    if count == 6:
        kind = given.reads or "displacement"
        return kind, [0, 1, 2] if kind == "displacement" else [3, 4, 5]
    if count != 3:
        raise refused(path, f"has {count} numbers a point, and 3 or 6 are known")
    if given.reads is None:
        raise refused(path, "has 3 numbers a point, and says not of what", 'give reads="displacement" or reads="force"')
    return given.reads, [0, 1, 2]


def _is_tactile(key: str, feature: Any) -> bool:
    shape = feature.get("shape") if isinstance(feature, dict) else None
    return "tactile" in key and isinstance(shape, list) and len(shape) == 2 and shape[1] in (3, 6)


def _features(path: str) -> dict[str, Any]:
    info = os.path.join(path, "meta", "info.json")
    try:
        if os.path.getsize(info) > 16 << 20:
            return {}
        with open(info, encoding="utf-8") as file:
            found = json.load(file).get("features", {})
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _table(path: str, feature: str | None) -> tuple[Any, str]:
    """The rows of all its files, with only the columns that are wanted."""
    arrow, parquet = optional("pyarrow", "tables"), optional("pyarrow.parquet", "tables")
    files = sorted(glob.glob(os.path.join(glob.escape(path), "data", "**", "*.parquet"), recursive=True))
    files = files if os.path.isdir(path) else [path]
    if not files:
        raise refused(path, "has no Parquet below data/", "is it a LeRobot data set of version 3?")
    if sum(map(os.path.getsize, files)) > MOST_BYTES:
        raise refused(
            path, f"has more than {MOST_BYTES >> 30} GiB", "one Parquet of its data folder, or fewer episodes"
        )
    try:
        there = parquet.read_schema(files[0]).names
        tactile = [one for one in there if "tactile" in one and not one.endswith(".sigma")]
        key = one_of(path, there if feature else tactile, feature, "column")
        wanted = [key, *(one for one in ("timestamp", "episode_index") if one in there)]
        return arrow.concat_tables([parquet.read_table(one, columns=wanted) for one in files]), key
    except (arrow.ArrowException, OSError) as error:
        raise refused(
            path, f"is not a whole Parquet: {str(error).partition(chr(10))[0]}", "was it copied as a whole?"
        ) from None


def _values(path: str, key: str, column: Any, shape: Any) -> NDArray[Any]:
    """(T, N, C) of nested lists, or of flat ones whose shape the data set tells."""
    column = getattr(column, "storage", column)  # of the type that Hugging Face's datasets registers
    frames, sizes = len(column), []
    while hasattr(column, "flatten") and hasattr(column.type, "value_type"):
        outer, column = len(column), column.flatten()
        sizes.append(len(column) // max(outer, 1))
    if isinstance(shape, list) and len(sizes) == 1:
        sizes = [int(one) for one in shape]
    values: NDArray[Any] = column.to_numpy(zero_copy_only=False)
    if len(sizes) != 2 or values.dtype.kind not in "fiu" or values.size != frames * sizes[0] * sizes[1]:
        raise refused(path, f"has in {key!r} no table of (points, 3 or 6) in each frame", "name= the tactile feature")
    return values.reshape(frames, *sizes)

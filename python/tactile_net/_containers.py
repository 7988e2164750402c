"""Containers of the layout that need NumPy alone: .npy, .npz, CSV. What each cannot hold, it refuses."""

from __future__ import annotations

import json
import re
import tokenize
import zipfile
import zlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._layout import Layout
from ._refusal import counted, cut_off, refused

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._scene import Scene

TIMES = ("t", "time", "timestamp", "timestamps")
"""What times are called, in the order of preference."""
CSV_MARK = "# tactile_net "

BROKEN = (
    zipfile.BadZipFile,
    zlib.error,
    tokenize.TokenError,
    EOFError,
    OSError,
    ValueError,
    ArithmeticError,
    MemoryError,
    RuntimeError,
    SyntaxError,
)
"""What NumPy raises of an archive or an array that is cut or damaged: shapes that no memory holds, methods of compression that
are not known, passwords, headers that are no Python, deep nesting."""


def chosen(where: str, named: dict[str, Any], name: str | None, kind: str) -> str:
    """Which of a stranger's arrays holds the readings: `name`, or `readings`, or the only one."""
    others = [one for one in named if one.rpartition("/")[2] not in TIMES]
    if name is None:
        found = [one for one in others if one.rpartition("/")[2] == "readings"] or others
        if len(found) == 1:
            return found[0]
    elif name in named:
        return name
    there = ", ".join(f"{one} {tuple(np.shape(named[one]))}" for one in list(named)[:20]) or "none"
    asked = "does not say which of them is the readings" if name is None else f"has no {kind} {name!r}"
    raise refused(where, f"{asked}; {kind}s: {there}", "name= one of them")


def beside(named: dict[str, Any], name: str) -> str | None:
    """Times that stand where the readings stand."""
    folder = name.rpartition("/")[0]
    paths = (f"{folder}/{one}" if folder else one for one in TIMES)
    return next((path for path in paths if path in named), None)


# .npz


def write_npz(path: str, layout: Layout) -> None:
    held: dict[str, Any] = {"attributes": np.array(json.dumps(layout.attributes)), **layout.arrays}
    with open(path, "wb") as file:
        np.savez(file, **held)


def read_npz(path: str, name: str | None) -> Layout:
    try:
        with open(path, "rb") as opened, np.load(opened, allow_pickle=False) as file:
            held = file.zip.namelist()
            arrays = {one: _plain(path, one, file) for one in file.files if f"{one}.npy" in held}
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError) as error:
        raise refused(
            path,
            f"is not a whole .npz file: {error}",
            "its table stands at its end, so that nothing of a part can be read",
        ) from None
    if not arrays:
        raise refused(path, "is a zip archive without arrays, as .xlsx files are", "save the sheet as CSV")
    if "attributes" in arrays and arrays["attributes"].dtype.kind == "U":
        return Layout(arrays, json.loads(str(arrays.pop("attributes"))))
    key = chosen(path, arrays, name, "array")
    at = beside(arrays, key)
    return Layout({"readings": arrays[key]} | ({} if at is None else {"t": arrays[at]}))


def _plain(path: str, name: str, file: Any) -> NDArray[Any]:
    try:
        array: NDArray[Any] = file[name]
    except (zipfile.BadZipFile, zlib.error, EOFError, OSError):
        raise  # of the archive
    except BROKEN as error:
        raise refused(path, f"{name}: {_words(error)}", _AS_FLOATS) from None
    return array


_AS_FLOATS = "save numbers: numpy.save(path, array.astype(float))"


def _words(error: Exception) -> str:
    pickled = "pickle" in str(error)
    return "holds Python objects, which can run anything when they are loaded" if pickled else str(error)


# .npy: one array, of readings.


def write_npy(path: str, layout: Layout) -> None:
    with open(path, "wb") as file:
        np.save(file, layout.arrays["readings"], allow_pickle=False)


def read_npy(path: str, name: str | None) -> Layout:
    form = np.lib.format
    with open(path, "rb") as file:
        try:
            header = form.read_array_header_1_0 if form.read_magic(file)[0] == 1 else form.read_array_header_2_0
            shape, fortran, dtype = header(file)
        except BROKEN as error:
            raise refused(path, f"has a header that cannot be read: {error}", _AS_FLOATS) from None
        if dtype.hasobject:
            raise refused(path, _words(ValueError("pickle")), _AS_FLOATS)
        data = file.read()
    count = int(np.prod(shape))
    if len(data) > count * dtype.itemsize:
        raise refused(path, f"goes on after the array of shape {shape} that its header tells of")
    notes = []
    if len(data) < count * dtype.itemsize:
        row = count // max(shape[0], 1) * dtype.itemsize if shape else 0
        if fortran or row == 0 or len(data) < row:
            raise refused(path, f"ends before the first whole frame of {shape}", "was it copied as a whole?")
        frames = len(data) // row
        notes.append(cut_off(path, frames, f"the end of the file; its header tells of {shape[0]}"))
        shape, data = (frames, *shape[1:]), data[: frames * row]
    array = np.frombuffer(data, dtype).reshape(shape, order="F" if fortran else "C")
    return Layout({"readings": array}, notes=notes)


# CSV: a comment with the attributes, names, and a row a frame; numbers as short as they may be to be the same double.


def write_csv(path: str, layout: Layout, scene: Scene) -> None:
    """Columns are named as the library's reader of files knows them, only if it would take these very numbers."""
    frames = len(layout.arrays["readings"])
    attributes = layout.attributes | {"frames": str(frames)}
    suffix = "" if takes_si(scene) else "_in_si"
    columns = [(f"{name}{suffix}", values) for name, values in columns_of(layout, scene)]
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(f"{CSV_MARK}{json.dumps(attributes)}\n{','.join(name for name, _ in columns)}\n")
        for row in zip(*(values.tolist() for _, values in columns)):
            file.write(",".join(map(repr, row)) + "\n")


def takes_si(scene: Scene) -> bool:
    """Whether a file of readings of this scene holds what `Recording.readings` holds."""
    one = np.ones((1, *scene.reading_shape))
    return "calibration" not in scene.to_dict() and bool((scene.raw_numbers(one) == one).all())


def columns_of(layout: Layout, scene: Scene) -> Iterable[tuple[str, NDArray[Any]]]:
    """Of a table with a frame a row: t, every reading, every component of the truth."""
    arrays = layout.arrays
    if "t" in arrays:
        yield "t", arrays["t"]
    readings = arrays["readings"]
    yield from zip(scene.reading_names, scene._ordered(readings).T)
    for u, component in enumerate(scene._components):
        if "truth" in arrays and u < arrays["truth"].shape[1]:
            places = np.ndindex(*scene.traction_shape)
            for at in places:
                yield "_".join(map(str, (component, *at))), arrays["truth"][(slice(None), u, *at)]


def read_own_csv(path: str) -> Layout:
    with open(path, encoding="utf-8", newline="\n") as file:
        try:
            attributes = json.loads(file.readline().removeprefix(CSV_MARK))
        except (ValueError, RecursionError) as error:
            raise refused(
                path, f"has a first line that cannot be read: {error}", "it tells of units and scene"
            ) from None
    columns, table, cut = _core.read_table(path)
    names = [one.removesuffix("_in_si") for one in columns]
    frames = int(attributes["frames"])
    notes: list[str] = []
    if cut is not None:
        notes.append(cut_off(path, len(table), f"line {cut[0]}, which is not whole: {cut[1]}"))
    elif len(table) != frames:
        notes.append(cut_off(path, len(table), f"the end of the file; it was of {counted(frames, 'frame')}"))
    return layout_from(names, table, attributes, notes)


def layout_from(names: list[str], table: NDArray[Any], attributes: dict[str, str], notes: list[str]) -> Layout:
    """Of the columns that `columns_of` made."""
    arrays: dict[str, NDArray[Any]] = {}
    components = [found for start in _TRUTHS if (found := _of(names, start))]
    if components:
        arrays["truth"] = np.stack([table[:, found] for found in components], axis=1)
    if names[:1] == ["t"]:
        arrays["t"] = table[:, 0]
    known = {*_of(names, "t", whole=True)}.union(*components)
    arrays["readings"] = table[:, [at for at in range(len(names)) if at not in known]]
    return Layout(arrays, attributes, notes=notes)


_TRUTHS = ("normal", "tangential", "tangential_y", "tangential_z")


def _of(names: list[str], start: str, whole: bool = False) -> list[int]:
    """Columns of that name, or of that name and numbers."""
    pattern = re.compile(re.escape(start) + ("" if whole else r"(_\d+)+"))
    return [at for at, name in enumerate(names) if pattern.fullmatch(name)]

"""PaXini PX-6AX GEN3: a force of 0.1 N a count at each point. CSV of the maker's program, or of paxini-sdk's recorder.

Points and normals are those of the model, of paxini-sdk: by `model=`, by the file, or by their number. Each point's z count is never below 0
and presses along its normal. The directions of its x and y are in no file: frame="sensor" takes all three along the axes of the
points, with z into the sensor; else z alone is read."""

from __future__ import annotations

import json
import re

import numpy as np

from .. import _core
from .._arrays import Floats
from .._geometry import QUANTITIES, Frames, Geometry, numbers_of, read_table
from .._refusal import counted, refused
from . import Given
from ._reading import gains, header_of, one_of, start_of

name = "paxini"
refusal = ""
NEWTONS = 0.1
_RANGES = ((-128, 127), (0, 255))
"""Of counts along x and y, and of z."""
_VENDOR = re.compile(r"(\d+-\d+)-NxN-([XYZ])\[(\d+)\]")
_NATIVE = re.compile(r"(.+)_pt(\d+)_f([xyz])_lsb")
_MOST = 1 << 30


def sniff(path: str) -> float:
    """Its column names."""
    return 0.95 if any(_VENDOR.fullmatch(one) or _NATIVE.fullmatch(one) for one in header_of(path)) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """Points of the model, and normals that were fitted to them."""
    module, columns = _columns(path, header_of(path), given)
    count = len(columns)
    known = {model: taxels.count("\n") - 1 for model, taxels in _core.sensor_models(name).items()}
    said = given.model or _model_in(path)
    alike = [model for model, points in known.items() if points == count]
    listed = f"model= one of (points): {', '.join(f'{model} ({points})' for model, points in known.items())}"
    if said is not None and said.upper() not in known:
        raise refused(path, f"is of no model {said!r}", f"{listed}; or geometry=")
    if said is None and len(alike) != 1:
        raise refused(path, f"has {count} points in module {module}, as no single model has", f"{listed}; or geometry=")
    model = alike[0] if said is None else said.upper()
    if known[model] != count:
        raise refused(path, f"has {count} points in module {module}, and {model} has {known[model]}", listed)
    notes = ["normals are fitted: quadrics through 12 neighbours of each point"]
    if said is None:
        notes.append(f"the model is taken to be {model}, the only one of {count} points")
    return Geometry.parse(_core.sensor_models(name)[model]).replace(reads=_reads(given), notes=notes, file=path)


def frames(path: str, given: Given) -> Frames:
    """Forces on each point [N]."""
    header, rows = read_table(path, _MOST)
    _, columns = _columns(path, header, given)
    column = {name: k for k, name in enumerate(header)}
    axes = "XYZ" if given.frame == "sensor" else "Z"
    counts = np.stack(
        [
            np.stack([numbers_of(path, one[axis], [row[column[one[axis]]] for row in rows]) for one in columns], axis=1)
            for axis in axes
        ],
        axis=2,
    )
    for k, axis in enumerate(axes):
        least, most = _RANGES[axis == "Z"]
        seen = counts[..., k]
        if (seen < least).any() or (seen > most).any():
            wrong = seen[(seen < least) | (seen > most)][0]
            hint = "the file of the maker's program or of paxini-sdk's recorder, as it was written"
            raise refused(path, f"has {wrong:g} in a column of {axis}, where counts are from {least} to {most}", hint)
    newtons = NEWTONS * counts * gains(path, given, len(axes))
    notes = ["z counts press along the normal; x and y, whose directions no file tells, are left out: frame="]
    if given.frame == "sensor":
        newtons[..., 2] = -newtons[..., 2]
        notes = ["counts are taken along the axes of the model's points, z into the sensor: gain= turns a sign"]
    ends = [_RANGES[one == "Z"][1] for one in axes]
    full = int((np.abs(counts) >= ends).any(axis=(1, 2)).sum())
    if full > 0:
        notes.append(f"{counted(full, 'frame')} with counts at the end of their range: forces there are too small")
    noise = NEWTONS / np.sqrt(12.0)
    return Frames(newtons, _times(path, header, rows), "N", given.frame or "local", noise, tuple(notes), path)


def _reads(given: Given) -> tuple[str, ...]:
    return QUANTITIES["force"] if given.frame == "sensor" else ("force_x",)


def _model_in(path: str) -> str | None:
    """What the native recorder wrote before the header."""
    first = start_of(path, 1 << 16).partition(b"\n")[0]
    if not first.startswith(b"# {"):
        return None
    try:
        told = json.loads(first[2:])
    except (ValueError, RecursionError):
        return None
    said = told.get("sensor_part") if isinstance(told, dict) else None
    return said if isinstance(said, str) else None


def _columns(path: str, header: list[str], given: Given) -> tuple[str, list[dict[str, str]]]:
    """The module that is meant, and of each of its points the columns of X, Y and Z."""
    modules: dict[str, dict[int, dict[str, str]]] = {}
    for name in header:
        if vendor := _VENDOR.fullmatch(name):
            module, axis, point = vendor[1], vendor[2], int(vendor[3])
        elif native := _NATIVE.fullmatch(name):
            module, axis, point = native[1], native[3].upper(), int(native[2])
        else:
            continue
        modules.setdefault(module, {}).setdefault(point, {})[axis] = name
    module = one_of(path, modules, given.name, "module")
    points = modules[module]
    if sorted(points) != list(range(len(points))) or any(set(one) != set("XYZ") for one in points.values()):
        raise refused(
            path, f"has not X, Y and Z of each point of module {module}", "record again, or restore the columns"
        )
    return module, [points[k] for k in range(len(points))]


def _times(path: str, header: list[str], rows: list[list[str]]) -> Floats | None:
    """Seconds: of the recorder's monotonic clock, or of the time of day, which goes on after midnight."""
    if "timestamp_monotonic_s" in header:
        k = header.index("timestamp_monotonic_s")
        return numbers_of(path, header[k], [row[k] for row in rows])
    if "Timestamp" not in header:
        return None
    k = header.index("Timestamp")
    day = np.empty(len(rows))
    for at, row in enumerate(rows):
        parts = row[k].split(":")
        try:
            hours, minutes, seconds = map(float, parts)
        except ValueError:
            raise refused(path, f"has the time {row[k]!r} in row {at + 1}, not hours:minutes:seconds") from None
        day[at] = 3600.0 * hours + 60.0 * minutes + seconds
    return day + 86400.0 * np.cumsum(np.diff(day, prepend=day[0]) < -43200.0)

"""FlexiTac: 12 x 32 pressures of 8 bits. The sensor's own stream, 0xAA 0x55 and a byte a taxel for each frame, or .npy of raw
frames (frames, rows, columns)."""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._geometry import Frames, Geometry
from .._refusal import refused
from . import Given
from ._reading import MOST_BYTES, array_in, counts_in_si, lattice, start_of

name = "flexitac"
refusal = ""
MARKER = b"\xaa\x55"
ROWS, COLUMNS = map(int, str(_core.sensor_lattice(name)).split("x"))


def sniff(path: str) -> float:
    """Two markers a frame apart."""
    start = start_of(path)
    size = 2 + ROWS * COLUMNS
    at = start.find(MARKER)
    return 0.9 if 0 <= at < size and start[at + size : at + size + 2] == MARKER else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """A flat lattice of the pitch that is given, z out of the pad."""
    counts, _ = _counts(path, given)
    places = lattice(path, given, *counts.shape[1:])
    normals = np.broadcast_to([0.0, 0.0, 1.0], places.shape)
    return Geometry(places, normals, reads=("force_x",), file=path)


def frames(path: str, given: Given) -> Frames:
    """Counts less those of the first frame, times gain=: forces or pressures. The stream has no times."""
    counts, notes = _counts(path, given)
    change = counts.astype(float).reshape(len(counts), -1, 1)
    values, unit, noise = counts_in_si(path, change - change[:1], given)
    notes = [*notes, "readings are less those of the first frame"]
    return Frames(values, None, unit, "local", noise, tuple(notes), path)


def _counts(path: str, given: Given) -> tuple[NDArray[np.uint8], list[str]]:
    """(T, rows, columns), and what was skipped. model="12x32" says another shape."""
    if start_of(path, 6) == b"\x93NUMPY":
        array = array_in(path)
        if array.ndim != 3 or array.dtype.kind not in "iu":
            raise refused(
                path,
                f"is {array.dtype} {array.shape}, not whole counts (frames, rows, columns)",
                "save frame.raw: frame.normalized is divided by each frame's own peak, and no force can be found from it",
            )
        return array, []
    if os.path.getsize(path) > MOST_BYTES:
        raise refused(path, f"has more than {MOST_BYTES >> 30} GiB", "cut it into parts")
    rows, columns = _shape(path, given)
    with open(path, "rb") as file:
        data = file.read()
    frames, at, skipped = [], 0, 0
    while True:
        found = data.find(MARKER, at)
        if found < 0 or found + 2 + rows * columns > len(data):
            skipped += len(data) - at
            break
        skipped += found - at
        at = found + 2 + rows * columns
        frames.append(np.frombuffer(data, np.uint8, rows * columns, found + 2))
    if not frames or skipped > len(data) // 2:
        raise refused(
            path,
            f"has {len(frames)} frames of {rows} x {columns} between markers AA 55, and {skipped} other bytes",
            'model="ROWSxCOLUMNS"',
        )
    notes = [f"{skipped} bytes between whole frames were skipped"] if skipped else []
    return np.stack(frames).reshape(-1, rows, columns), notes


def _shape(path: str, given: Given) -> tuple[int, int]:
    if given.model is None:
        return ROWS, COLUMNS
    parts = given.model.lower().split("x")
    if len(parts) != 2 or not all(one.isdecimal() and 0 < int(one) <= 256 for one in parts):
        raise refused(path, f"is of the model {given.model!r}", 'model="12x32": rows and columns')
    return int(parts[0]), int(parts[1])

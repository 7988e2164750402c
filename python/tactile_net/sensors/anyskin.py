"""AnySkin, ReSkin: magnetic fields at 5 chips of a skin with magnetic particles. .npy (frames, 1 + 3 or 4 a chip) of get_data:
time [s], then of each chip [temperature,] Bx, By, Bz."""

from __future__ import annotations

import os

from .. import _core
from .._geometry import Frames, Geometry
from .._refusal import refused
from . import Given
from ._reading import array_in, start_of

name = "anyskin"
refusal = _core.sensor_refusal(name)


def sniff(path: str) -> float:
    """A .npy that is called so: nothing in it tells."""
    named = any(word in os.path.basename(path).lower() for word in ("anyskin", "reskin"))
    return 0.7 if named and start_of(path, 6) == b"\x93NUMPY" else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """None is in the format."""
    raise refused(path, "has no places of its chips", "geometry= a tn.Geometry, or its CSV")


def frames(path: str, given: Given) -> Frames:
    """Bx, By, Bz of each chip, in the chip's unit; a temperature before them is left out."""
    rows = array_in(path)
    if rows.ndim != 2 or rows.shape[1] < 4:
        raise refused(
            path,
            f"has the shape {rows.shape}, not (frames, 1 + 3 or 4 for each chip)",
            "numpy.save(path, get_data(...))",
        )
    numbers = rows.shape[1] - 1
    three, four = numbers % 3 == 0, numbers % 4 == 0
    if three == four and given.model not in ("3", "4"):
        raise refused(
            path,
            f"has {numbers} numbers a frame: 3 or 4 a chip?",
            'model="3" without temperatures, model="4" with them',
        )
    width = int(given.model) if given.model in ("3", "4") else 3 if three else 4
    if numbers % width:
        raise refused(path, f"has {numbers} numbers a frame, which are not {width} a chip")
    values = rows[:, 1:].reshape(len(rows), -1, width)[..., width - 3 :]
    notes = ("fields are in the chips' own unit",) + (("temperatures are left out",) if width == 4 else ())
    return Frames(values.astype(float), rows[:, 0].astype(float), "T", "sensor", notes=notes, file=path)

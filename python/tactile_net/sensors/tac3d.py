"""Tac3D: a dome of 20 x 20 markers. Folders as PyTac3D's DataRecorder writes them: 3D_Positions.npy, 3D_Displacements.npy [mm],
sendTimestamp.npy [s]. Forces and normals that stand there too are the maker's own answer, and are not read."""

from __future__ import annotations

import glob
import os

import numpy as np
from numpy.typing import NDArray

from .._arrays import Floats
from .._geometry import QUANTITIES, Frames, Geometry
from .._refusal import refused
from . import Given
from ._reading import array_in, one_of

name = "tac3d"
refusal = ""
_MOVED, _PLACES, _TIMES = "3D_Displacements.npy", "3D_Positions.npy", "sendTimestamp.npy"


def sniff(path: str) -> float:
    """A folder with positions and displacements, or one with such folders."""
    return 0.95 if any(os.path.exists(os.path.join(one, _PLACES)) for one in _recordings(path)) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """Of the rest positions: positions less displacements, the median over the frames."""
    folder = _folder(path, given)
    places, moved = _points(folder, _PLACES), _points(folder, _MOVED)
    if places.shape != moved.shape:
        raise refused(
            folder, f"has positions {places.shape} and displacements {moved.shape}", "copy the recording as a whole"
        )
    rests = places - moved
    rest = np.median(rests, axis=0)
    strayed = float(np.abs(rests - rest).max())
    notes = () if strayed < 1e-6 else (f"rest positions vary by up to {strayed:.2g} mm: their median is taken",)
    return Geometry(1e-3 * rest, reads=QUANTITIES["displacement"], notes=notes, shape="sphere", file=folder)


def frames(path: str, given: Given) -> Frames:
    """Displacements along the sensor's axes."""
    folder = _folder(path, given)
    moved = 1e-3 * _points(folder, _MOVED)
    at = os.path.join(folder, _TIMES)
    t = np.asarray(array_in(at), dtype=float) if os.path.exists(at) else None
    still = int((np.abs(moved).max(axis=(1, 2)) == 0.0).sum())
    notes = [f"{still} of {len(moved)} frames have no displacement at all"] if still else []
    return Frames(moved, t, "m", "sensor", notes=(*notes, *_beyond(moved)), file=folder)


def _beyond(moved: Floats) -> list[str]:
    largest = float(np.nanmax(np.abs(moved)))
    if largest < 0.5e-3:
        return []
    return [f"displacements reach {1e3 * largest:.2g} mm: the pad's model is of small ones"]


def _recordings(path: str) -> list[str]:
    there = [path, *sorted(glob.glob(os.path.join(glob.escape(path), "*/")))] if os.path.isdir(path) else []
    return [one for one in there[:1000] if os.path.exists(os.path.join(one, _MOVED))]


def _folder(path: str, given: Given) -> str:
    """That of one sensor: `path`, or the folder in it that is called by the serial number."""
    found = _recordings(path)
    if found and os.path.samefile(found[0], path):
        return path
    if not found:
        raise refused(
            path, f"has no {_MOVED}", "the folder that PyTac3D.DataRecorder.save wrote, or one of its sensors"
        )
    serial = one_of(path, (os.path.basename(os.path.normpath(one)) for one in found), given.name, "sensor")
    return os.path.join(path, serial)


def _points(folder: str, file: str) -> NDArray[np.float64]:
    where = os.path.join(folder, file)
    if not os.path.exists(where):
        raise refused(folder, f"has no {file}", "copy the recording as a whole")
    array = array_in(where)
    if array.ndim != 3 or array.shape[2] != 3 or 0 in array.shape:
        raise refused(where, f"has the shape {array.shape}, not (frames, markers, 3)")
    return np.asarray(array, dtype=float)

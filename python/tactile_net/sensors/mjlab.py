"""mjlab's TactileSensor: depth (frames, rows, columns) [m] and slip (..., 2) [m/s] over a grid on a geom. .npz with `depth`."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._geometry import Frames, Geometry
from .._refusal import refused
from . import Given
from ._reading import arrays_in, lattice, start_of, times_in

name = "mjlab"
refusal = _core.sensor_refusal(name)


def sniff(path: str) -> float:
    """A .npz with depth and slip."""
    start = start_of(path, 1 << 16)
    return 0.8 if start.startswith(b"PK") and b"depth.npy" in start and b"slip.npy" in start else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """The grid in the frame of the pad before it is laid on the geom: rows along x, columns along y, z out of it."""
    depth, _ = _images(path)
    places = lattice(path, given, *depth.shape[1:])
    normals = np.broadcast_to([0.0, 0.0, 1.0], places.shape)
    return Geometry(places, normals, reads=("depth", "slip_x", "slip_y"), file=path)


def frames(path: str, given: Given) -> Frames:
    """Depth [m] and slip along the pad's x and y [m/s]; units tells that of the first."""
    depth, slip = _images(path)
    values = np.concatenate([depth[..., np.newaxis], slip], axis=3).reshape(len(depth), -1, 3)
    notes = ("channel 0 is a depth [m], 1 and 2 slip [m/s]",)
    return Frames(values, times_in(arrays_in(path), len(depth)), "m", "local", notes=notes, file=path)


def _images(path: str) -> tuple[np.ndarray, np.ndarray]:
    arrays = arrays_in(path)
    depth, slip = arrays.get("depth"), arrays.get("slip")
    if depth is None or slip is None or depth.ndim != 3 or slip.shape != (*depth.shape, 2):
        shapes = {name: array.shape for name, array in arrays.items()}
        raise refused(
            path, f"has {shapes}, not depth (frames, rows, columns) and slip (..., 2)", "one environment of the batch"
        )
    return depth.astype(float), slip.astype(float)

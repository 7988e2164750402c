"""Readings as the library takes them: rows of float64, one frame each."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Floats", "channels_first", "frames_of", "lattice_frames_of", "plain"]

Floats: TypeAlias = "NDArray[np.float64]"


def plain(values: ArrayLike, what: str) -> Floats:
    """As float64; refuses what would lose a mask, an imaginary part or a meaning."""
    if isinstance(values, np.ma.MaskedArray):
        raise ValueError(
            f"{what} is a masked array, whose mask would be lost: fill it first, with nan where values are missing"
        )
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{what} must be numbers, got {array.dtype} {array.shape}")
    return np.asarray(array, dtype=np.float64, order="C")


def frames_of(
    readings: Any, shape: tuple[int, ...], what: str = "readings", ends: tuple[str, ...] = ("channel", "taxel")
) -> tuple[Floats, tuple[int, ...]]:
    """Readings of shape (..., *shape), or (..., R) with R their product, as rows and the shape that leads.

    ends: the last dimensions of an xarray.DataArray.
    """
    dims = getattr(readings, "dims", None)
    if dims is not None and tuple(dims[-len(ends) :]) not in ((), ends) and dims[-1] != "reading":
        raise ValueError(f"{what} must end in the dimensions ({', '.join(ends)}), got {tuple(dims)}")
    array = plain(readings, what)
    size = int(np.prod(shape))
    if array.shape[-len(shape) :] == shape:
        lead = array.shape[: -len(shape)]
    elif array.ndim > 0 and array.shape[-1] == size:
        lead = array.shape[:-1]
    else:
        one = " or ".join(dict.fromkeys((f"(..., {', '.join(map(str, shape))})", f"(..., {size})")))
        raise ValueError(f"{what} must be of shape {one}, got {array.shape}")
    return array.reshape(-1, size), lead


def lattice_frames_of(readings: Any, shape: tuple[int, ...], what: str = "readings") -> tuple[Floats, tuple[int, ...]]:
    """The same of a skin whose frames have `shape`, rows, columns, channels: rows of them are channel after channel."""
    rows, lead = frames_of(readings, shape, what, ("row", "column", "channel"))
    if np.shape(readings)[-len(shape) :] != shape:
        return rows, lead
    return channels_first(rows.reshape(-1, *shape)), lead


def channels_first(frames: NDArray[Any]) -> NDArray[Any]:
    """(T, rows, columns, C) as (T, R), channel after channel."""
    return np.moveaxis(frames, -1, 1).reshape(len(frames), math.prod(frames.shape[1:]))

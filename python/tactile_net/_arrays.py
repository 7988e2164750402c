"""Readings as the library takes them: rows of float64, one frame each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Floats", "frames_of", "plain"]

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

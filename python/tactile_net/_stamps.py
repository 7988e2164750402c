"""Times as whole nanoseconds, and back: a double of seconds since 1970 has steps of 0.24 us."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import Floats

_SECOND = 10**9


def seconds_of(stamps: Any) -> Floats:
    """[s], of whole nanoseconds."""
    whole = np.asarray(stamps, dtype=np.int64)
    return np.asarray(whole // _SECOND + whole % _SECOND / _SECOND)


def nanoseconds_of(t: Floats) -> list[int]:
    """The nearest, of seconds below 2^31."""
    whole = np.floor(t)
    stamps: list[int] = (whole.astype(np.int64) * _SECOND + np.rint((t - whole) * _SECOND).astype(np.int64)).tolist()
    return stamps

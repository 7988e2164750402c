"""What adapters have alike: arrays of files with bounds, units, gains, and which of several is meant."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._arrays import Floats
from .._containers import BROKEN, read_npy
from .._judge import numbers
from .._refusal import refused

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from . import Given

MOST_BYTES = 2 << 30
"""Of the arrays of one file, unpacked."""
_FORCES = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "uN": 1e-6}
_SI = {"displacement": "m", "force": "N", "stress": "Pa"}


def start_of(path: str, count: int = 4096) -> bytes:
    """The first bytes of a file; of a folder, and of what cannot be read, none."""
    try:
        with open(path, "rb") as file:
            return file.read(count)
    except OSError:
        return b""


def header_of(path: str) -> list[str]:
    """The names in the first line that is no comment, if it is text."""
    try:
        lines = start_of(path, 1 << 16).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        return []
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    return [one.strip().strip('"') for one in first.split(",")]


def array_in(path: str) -> NDArray[Any]:
    """Of a .npy, its whole frames. Raises InputError: pickles, more than 2 GiB, no numbers."""
    if os.path.getsize(path) > MOST_BYTES:
        raise refused(path, f"has more than {MOST_BYTES >> 30} GiB", "cut it into parts")
    if start_of(path, 6) != b"\x93NUMPY":
        raise refused(path, "is no .npy file", "save numbers: numpy.save(path, array)")
    return numbers(path, read_npy(path, None).arrays["readings"])


def arrays_in(path: str) -> dict[str, NDArray[Any]]:
    """Of a .npz, those that are numbers. Raises InputError: pickles, more than 2 GiB unpacked, a broken file."""
    try:
        with open(path, "rb") as opened, np.load(opened, allow_pickle=False) as file:
            if isinstance(file, np.ndarray):
                raise refused(path, "is one array, and no .npz file", "numpy.savez(path, name=array, ...)")
            if sum(one.file_size for one in file.zip.infolist()) > MOST_BYTES:
                raise refused(path, f"unpacks to more than {MOST_BYTES >> 30} GiB", "cut it into parts")
            found = {name: file[name] for name in file.files}
    except BROKEN as error:
        if type(error).__name__ == "InputError":
            raise
        words = (
            "holds Python objects, which can run anything" if "pickle" in str(error) else f"is no .npz file: {error}"
        )
        raise refused(path, words, "save numbers: numpy.savez(path, name=array.astype(float))") from None
    return {name: array for name, array in found.items() if array.dtype.kind in "fiu"}


def times_in(arrays: Mapping[str, NDArray[Any]], first: int) -> Floats | None:
    """Times that stand under one of their usual names, in seconds from the first frame where they are stamps."""
    for name in ("t", "time", "times", "timestamp", "timestamps"):
        if name in arrays and arrays[name].shape == (first,):
            return np.asarray(arrays[name], dtype=float)
    return None


def one_of(path: str, found: Iterable[str], name: str | None, what: str) -> str:
    """The one that `name` says, or the only one. Raises InputError that lists them."""
    there = list(dict.fromkeys(found))
    if name is not None and name in there:
        return name
    if name is None and len(there) == 1:
        return there[0]
    listed = ", ".join(there[:20]) or "none"
    wrong = f"has {len(there)} {what}s" if name is None else f"has no {what} {name!r}"
    raise refused(path, f"{wrong}: {listed}", "name= one of them" if there else "is it a file of this sensor?")


def si_factor(path: str, unit: str, kind: str) -> float:
    """Of a unit in SI. Raises InputError with those that are known."""
    if kind == "force":
        known = {name: (times, 1.0) for name, times in _FORCES.items()}
    else:
        known = _core.length_units() if kind == "displacement" else _core.stress_units()
    if unit not in known:
        raise refused(path, f"has a {kind} in {unit!r}: units that are known: {', '.join(known)}")
    times, over = known[unit]
    return times / over


def unit_given(path: str, given: Given, kind: str) -> str:
    """The unit of this kind that `units=` says. Raises InputError where it says none: none is guessed."""
    units = given.units
    said = units.get(kind) if isinstance(units, Mapping) else units
    if said is None:
        raise refused(
            path, f"does not say in which unit its {kind}s are", f'give units="{_SI[kind]}", or whatever they are in'
        )
    return said


def in_si(path: str, values: NDArray[Any], given: Given, kind: str) -> Floats:
    """Numbers of the unit that `units=` says, times the gain that `gain=` says, if any."""
    factor = si_factor(path, unit_given(path, given, kind), kind)
    return np.asarray(values, dtype=float) * factor * gains(path, given, values.shape[-1])


def gains(path: str, given: Given, channels: int) -> Floats:
    """One number a channel; 1 where none is given."""
    gain = np.asarray(1.0 if given.gain is None else given.gain, dtype=float)
    if gain.shape not in ((), (channels,)) or not np.isfinite(gain).all() or (gain == 0.0).any():
        raise refused(
            path, f"has {channels} channels, and gain={given.gain!r}", "one number that is not 0, or one a channel"
        )
    return np.broadcast_to(gain, (channels,))


def counts_in_si(path: str, counts: NDArray[Any], given: Given) -> tuple[Floats, str, float]:
    """Counts times their gain, the SI unit they are then in, and the deviation that rounding leaves.

    Raises InputError that asks for gain and unit.
    """
    if given.gain is None or not isinstance(given.units, str):
        raise refused(
            path,
            "has counts of a converter, and says not what one count is",
            'give gain= and units= of one count, as a calibration found them: gain=0.02, units="N", or units="Pa"',
        )
    kind = "force" if given.units in _FORCES else "stress"
    factor = si_factor(path, given.units, kind) * gains(path, given, counts.shape[-1])
    return np.asarray(counts, dtype=float) * factor, _SI[kind], float(np.abs(factor).max()) / np.sqrt(12.0)


def lattice(path: str, given: Given, rows: int, columns: int) -> Floats:
    """(rows * columns, 3): row after row in the plane z = 0 about 0, rows along x and columns along y. Raises InputError
    without a pitch."""
    if given.pitch is None:
        raise refused(path, f"has {rows} x {columns} taxels, and says not how far they are apart", "give pitch= [m]")
    pitch: Sequence[float] | Any = np.broadcast_to(np.asarray(given.pitch, dtype=float), (2,))
    x = (np.arange(rows) - 0.5 * (rows - 1)) * pitch[0]
    y = (np.arange(columns) - 0.5 * (columns - 1)) * pitch[1]
    return np.stack([np.repeat(x, columns), np.tile(y, rows), np.zeros(rows * columns)], axis=1)

"""Whether arrays from elsewhere are frames of a scene: their shape, their units, their times, what is missing."""

from __future__ import annotations

import io
import itertools
import json
import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from . import _core
from ._arrays import Floats
from ._files import no_scene
from ._layout import Layout, scene_in, units_by_channel
from ._recording import Recording
from ._refusal import counted, refused
from ._stamps import seconds_of
from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._scene import Scene

Units: TypeAlias = str | Mapping[str, str]


def judged(layout: Layout, where: str, scene: Scene | None, units: Units | None, missing: bool) -> Recording:
    """The recording that a file holds. Raises InputError with what is wrong, and what to do about it."""
    with as_it_says(where) if layout.own else nullcontext():
        return _judged(layout, where, scene, units, missing)


@contextmanager
def as_it_says(where: str) -> Iterator[None]:
    """What claims to be of the layout may have been written by anybody: whatever does not fit is the file's fault."""
    try:
        yield
    except InputError:
        raise
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise refused(where, f"is not of the layout that it says it is: {type(error).__name__} {error}") from error


def _judged(layout: Layout, where: str, scene: Scene | None, units: Units | None, missing: bool) -> Recording:
    if scene is None:
        if not layout.own:
            raise no_scene(where)
        scene = scene_in(layout, where)
    held = layout.arrays["readings"]
    if layout.columns is not None:
        held = held[:, order_of(where, layout.columns, scene)]
    readings = shaped(where, numbers(where, held), scene)
    if layout.own:
        if units is not None:
            raise refused(where, "states the units of its readings", "leave units= out")
        values = _converted(where, readings, scene, json.loads(layout.attributes["units"]))
        notes = [*json.loads(layout.attributes["notes"]), *layout.notes]
    else:
        values, more = in_si(where, readings, scene, units, layout.units)
        notes = [*layout.notes, *more]
    t = layout.arrays.get("t")
    times: Floats | None = None
    if t is not None:
        times, more = seconds(where, t, len(values), layout.own or layout.seconds)
        notes += [*more, *rising(where, times)]
    notes += absent(where, values, scene, missing)
    truth = layout.arrays.get("truth")
    known = None if truth is None else np.asarray(truth, dtype=np.float64)
    places = scene.traction_shape
    if known is not None and known.shape[2:] == (math.prod(places),):  # of a table's columns
        known = known.reshape(*known.shape[:2], *places)
    if known is not None and (known.shape[:1] != (len(values),) or known.shape[2:] != places or known.ndim < 3):
        wanted = ", ".join(map(str, (len(values), "components", *places)))
        raise refused(where, f"has a truth of the shape {known.shape}, not ({wanted})")
    return Recording(scene, values, times, known, tuple(dict.fromkeys(notes)))


def order_of(where: str, columns: list[str], scene: Scene) -> list[int]:
    """Where each reading stands: by the scene's names, or by numbers that count through the columns."""
    names = scene.reading_names
    if set(columns) == set(names):
        return [columns.index(name) for name in names]
    counted_through = [int(re.findall(r"\d+", name)[-1]) for name in columns]
    if counted_through != list(range(counted_through[0], counted_through[0] + len(columns))):
        shown = ", ".join(columns[:4])
        hint = f"name them as the scene does, {names[0]} to {names[-1]}"
        raise refused(where, f"has readings in columns whose order is not clear: {shown}, ...", hint)
    return list(range(len(columns)))


def numbers(where: str, values: Any) -> NDArray[Any]:
    array: NDArray[Any] = np.asarray(values)
    if array.dtype.kind not in "fiu" or isinstance(values, np.ma.MaskedArray):
        kind = "masked" if isinstance(values, np.ma.MaskedArray) else str(array.dtype)
        raise refused(where, f"has readings that are {kind}, not plain numbers", "save them as float64")
    return array


def shaped(where: str, readings: NDArray[Any], scene: Scene) -> NDArray[Any]:
    """(T, *scene.reading_shape)"""
    shape, size = scene.reading_shape, len(scene.reading_names)
    if readings.shape[1:] == shape:
        return readings
    if readings.shape[1:] == (size,):
        return scene._framed(readings)
    if readings.shape in (shape, (size,)):
        return scene._framed(scene._ordered(readings[np.newaxis]))
    wanted = ", ".join(map(str, ("frames", *shape)))
    hint = f"or (frames, {size}): channel after channel, taxel after taxel"
    if readings.ndim == 2 and readings.shape[0] == size:
        hint = "rows and columns are exchanged: readings.T"
    orders = list(itertools.permutations(range(readings.ndim))) if readings.ndim == len(shape) + 1 > 2 else []
    for order in orders:
        if tuple(readings.shape[axis] for axis in order[1:]) == shape:
            hint = f"its axes are exchanged: readings.transpose{order}"
            break
    raise refused(where, f"has readings of the shape {readings.shape}, not ({wanted})", hint)


def in_si(
    where: str, readings: NDArray[Any], scene: Scene, units: Units | None, stated: Units | None
) -> tuple[Floats, list[str]]:
    """A stranger's numbers as readings, and what was taken for granted.

    units: of who calls; stated: of the file. "scene": as the scene says of its files of readings, calibration and all.
    """
    tables = scene.to_dict()
    if units is not None and stated is not None and units != stated:
        raise refused(where, f"states the unit {stated!r}, and units={units!r} was given", "leave units= out")
    said = units if units is not None else stated
    if said is None and not {"units", "calibration"} & tables.keys():
        raise refused(
            where,
            "says no units of its readings, and neither does the scene",
            'give units="kPa" and the scene a table [units]; or units="scene" if they are those of its numbers',
        )
    if said is None or said == "scene":
        if readings.dtype.kind != "f" and "calibration" not in tables:
            raise refused(
                where,
                f"has whole numbers ({readings.dtype}), as a converter gives, and nothing says what one count is",
                "give the scene a table [calibration] with their gain, or units= if they are whole units",
            )
        return _taken(where, readings, scene)
    values = _converted(where, readings, scene, said)
    dead = np.isin(scene.sites.taxel, tables.get("dead_taxels", {}).get("indices", []))
    flat = scene._ordered(np.where(np.isfinite(values), values, np.nan))
    flat[:, dead] = 0.0
    return scene._framed(flat), []


def _taken(where: str, readings: NDArray[Any], scene: Scene) -> tuple[Floats, list[str]]:
    """By the library's reader of files: the scene's units, calibration, dead taxels."""
    file = io.BytesIO()
    np.save(file, np.ascontiguousarray(scene._ordered(readings)))
    try:
        _, values, notes = scene._core.take(file.getvalue())
    except InputError as error:
        raise InputError(str(error).replace("<stdin>", where), error.diagnostics) from None
    return scene._framed(values), notes


def _converted(where: str, readings: NDArray[Any], scene: Scene, units: Units) -> Floats:
    values = np.array(readings, dtype=np.float64, order="C")
    known = units_by_channel(scene)
    if isinstance(units, str):
        units = known if units == "SI" else {name: "1" if si == "1" else units for name, si in known.items()}
    unknown = units.keys() - known.keys()
    if unknown or units.keys() != known.keys():
        raise refused(
            where,
            f"has units of {', '.join(sorted(units))}, and the scene reads {', '.join(known)}",
            "name each of these",
        )
    scales = {"Pa": _core.stress_units(), "m": _core.length_units()}
    channels = scene.sites.channel
    flat = scene._ordered(values)
    for channel, name in enumerate(scene.channels):
        unit, si = units[name], known[name]
        if unit == si:
            continue
        if si == "":
            raise refused(where, f"is in {unit}, and the scene does not say what it is in", "give it a table [units]")
        if unit not in scales.get(si, {}):
            of = "1, a strain has none" if si == "1" else ", ".join(scales[si])
            raise refused(where, f"states the unit {unit!r} of {name}", f"units that are known: {of}")
        times, over = scales[si][unit]
        flat[:, channels == channel] *= times
        flat[:, channels == channel] /= over
    return scene._framed(flat)


def seconds(where: str, t: Any, frames: int, stated: bool) -> tuple[Floats, list[str]]:
    """Times of frames [s], and what was taken for granted.

    stated: they are seconds; else they are what their size says, as in files of readings.
    """
    array = np.asarray(t)
    if array.dtype.kind == "M":
        array, stated = seconds_of(array.astype("datetime64[ns]").astype(np.int64)), True
    if array.dtype.kind not in "fiu" or array.shape != (frames,):
        raise refused(
            where,
            f"has {counted(frames, 'frame')} and times of the shape {array.shape}, {array.dtype}",
            "seconds, one a frame",
        )
    times = np.array(array, dtype=np.float64)
    return (times, []) if stated else _core.seconds(times.tolist())


def rising(where: str, t: Floats) -> list[str]:
    """What is to be said of duplicate and missing frames. Raises InputError where time goes back."""
    steps = np.diff(t)
    back = np.flatnonzero(steps < 0)
    if back.size > 0:
        k = int(back[0])
        raise refused(
            where,
            f"goes back in time: frame {k + 1} is at {t[k + 1]:g} s, frame {k} at {t[k]:g} s",
            "sort the frames by time, or save them without times",
        )
    notes = []
    same = np.flatnonzero(steps == 0)
    if same.size > 0:
        notes.append(f"{counted(same.size, 'frame')} at the time of the one before, the first is frame {same[0] + 1}")
    usual = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    gaps = np.flatnonzero(steps > 1.5 * usual) if usual > 0 else same[:0]
    if gaps.size > 0:
        longest = int(gaps[np.argmax(steps[gaps])])
        lost = int(np.sum(np.rint(steps[gaps] / usual)) - gaps.size)
        notes.append(
            f"{counted(gaps.size, 'gap')} in time, about {counted(lost, 'frame')} missing at {usual:g} s a frame; "
            f"the longest lasts {steps[longest]:g} s, after frame {longest}"
        )
    return notes


def absent(where: str, values: Floats, scene: Scene, missing: bool) -> list[str]:
    """What is to be said of readings that are not finite, or InputError where they may not be `missing`."""
    flat = scene._ordered(values)
    gone = ~np.isfinite(flat)
    dead = np.isin(scene.sites.taxel, scene.to_dict().get("dead_taxels", {}).get("indices", []))
    gone[:, dead] = False
    if not gone.any():
        return []
    frame, reading = (int(at[0]) for at in np.nonzero(gone))
    first = f"frame {frame}, {scene.reading_names[reading]} ({flat[frame, reading]})"
    if not missing:
        raise refused(where, f"{first} is not finite", "missing=True takes them for missing values")
    return [f"{counted(int(gone.any(axis=1).sum()), 'frame')} with readings that are missing, the first: {first}"]

"""Where the taxels of a sensor are, which way its surface faces there, and what they read; and frames of their readings."""

from __future__ import annotations

import csv
import dataclasses
import io
from collections.abc import Iterable, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from . import _core
from ._arrays import Floats, plain
from ._refusal import counted, refused
from ._surface import areas_of, fitted_normals

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Frames", "Geometry"]

MOST_TAXELS = 4096
"""The library's matrices are dense."""
MOST_BYTES = 64 << 20
"""Of a file of taxels, some 100 bytes each."""
QUANTITIES = {
    "displacement": ("displacement_x", "displacement_y", "displacement_z"),
    "force": ("force_x", "force_y", "force_z"),
    "stress": ("stress_x", "shear_xy", "shear_xz"),
}
"""The three components of what a taxel reads; of the sensor's frame or of its own, as `Frames.frame` says."""
_PLACES, _NORMALS = ("x", "y", "z"), ("nx", "ny", "nz")
_COLUMNS = ("name", *_PLACES, *_NORMALS, "depth", "reads")


@dataclasses.dataclass(init=False, frozen=True, eq=False)
class Geometry:
    """Taxels of a sensor in space, in the sensor's own right-handed frame [m].

    geometry = tn.Geometry(positions, depth=1e-3, reads=["displacement_x", "displacement_y", "displacement_z"])

    Normals that are not given are fitted: a quadric through 12 neighbours of each taxel, turned outward, which is where a
    curved array bulges to, and of any array the side of `outward`. A note says how far the quadrics miss.
    Raises InputError: fewer than 3 taxels or more than 4096, two at one place, all on a line, a normal that is not of unit
    length within 1e-3, an extent below 1 mm or above 1 m, a depth that is not above 0.
    """

    positions: Floats
    """(N, 3): of the taxels themselves, at their depth [m]."""
    normals: Floats
    """(N, 3): of unit length, out of the pad."""
    depth: Floats | None
    """(N,): of each taxel below the surface [m]; None: not known."""
    reads: tuple[str, ...]
    """What each taxel reads, in the order of the channels of `Frames`."""
    names: tuple[str, ...]
    """Of the taxels: "t0", "t1", ... where none are given."""
    notes: tuple[str, ...]
    """What was fitted or taken for granted."""
    shape: str
    """What the surface is known to be: "sphere", "points" (any smooth one), as of [surface]; "": as the taxels tell."""
    file: str
    """In messages."""

    def __init__(
        self,
        positions: ArrayLike,
        normals: ArrayLike | None = None,
        depth: ArrayLike | None = None,
        reads: Sequence[str] = (),
        names: Sequence[str] = (),
        *,
        outward: Sequence[float] | None = None,
        notes: Sequence[str] = (),
        shape: str = "",
        file: str = "geometry",
    ) -> None:
        places = _triples(file, "positions", positions)
        count = len(places)
        if not 3 <= count <= MOST_TAXELS:
            raise refused(file, f"has {counted(count, 'taxel')}: from 3 to {MOST_TAXELS} are possible")
        _check_extent(file, places)
        called = tuple(map(str, names)) or tuple(f"t{k}" for k in range(count))
        if len(called) != count or len(set(called)) != count or not all(called):
            raise refused(file, f"has {count} taxels and {len(set(called))} names", "name each, and no two alike")
        if len(set(reads)) != len(reads):
            raise refused(file, f"reads one quantity twice: {', '.join(reads)}")
        below = None if depth is None else plain(depth, "depth")
        if below is not None:
            if below.shape not in ((), (count,)) or not (np.isfinite(below) & (below > 0.0)).all():
                raise refused(file, f"has a depth that is not above 0, or depths {below.shape} of {count} taxels")
            below = np.array(np.broadcast_to(below, (count,)))
        known = tuple(notes)
        if normals is None:
            sides, note = fitted_normals(file, places, outward)
            known = (*known, note)
        else:
            sides = _unit(file, _triples(file, "normals", normals), called)
        values = (places, sides, below, tuple(reads), called, known, shape, file)
        for field, value in zip(dataclasses.fields(self), values, strict=True):
            object.__setattr__(self, field.name, value)

    @classmethod
    def load(cls, path: str | PathLike[str], *, unit: str | None = None) -> Self:
        """From CSV: name, x, y, z, nx, ny, nz, depth, reads, of which x, y and z are needed. Lengths are in metres, or as the
        header says: "x [mm]".

        unit: of a file whose header says none. Raises InputError with what is wrong and what to do.
        """
        where = fspath(path)
        return cls._of(where, *read_table(where), unit)

    @classmethod
    def parse(cls, text: str, *, unit: str | None = None, file: str = "geometry") -> Self:
        """As `load`, of the text of such a file. file: in messages."""
        return cls._of(file, *_table_of(file, text.splitlines(keepends=True)), unit)

    @classmethod
    def _of(cls, where: str, header: list[str], rows: list[list[str]], unit: str | None) -> Self:
        named, scale = _without_units(where, header, unit)
        if set(_PLACES) - set(named):
            raise refused(where, f"has the columns {', '.join(named)}, and x, y and z are needed")
        if 0 < len(set(_NORMALS) & set(named)) < 3:
            raise refused(where, "has one or two of nx, ny and nz", "all three, or none: then they are fitted")
        column = {name: [row[k] for row in rows] for k, name in enumerate(named)}
        numbers = {
            name: numbers_of(where, name, texts) for name, texts in column.items() if name not in ("name", "reads")
        }
        different = {tuple(one.split()) for one in column.get("reads", [])}
        if len(different) > 1:
            raise refused(
                where, "has taxels that read different quantities", "a file of a sensor has the same in each row"
            )
        return cls(
            np.stack([numbers[name] * scale for name in _PLACES], axis=1),
            np.stack([numbers[name] for name in _NORMALS], axis=1) if "nx" in named else None,
            numbers["depth"] * scale if "depth" in named else None,
            next(iter(different), ()),
            tuple(column.get("name", ())),
            file=where,
        )

    def save(self, path: str | PathLike[str]) -> None:
        """As CSV that `load` and the library read: name,x,y,z,nx,ny,nz,depth,reads in metres; what is not known has no column."""
        from ._files import whole

        with whole(fspath(path)) as to, open(to, "w", encoding="utf-8", newline="\n") as file:
            file.write(self.text())

    def text(self) -> str:
        """What `save` writes."""
        out = io.StringIO()
        left_out = {"depth": self.depth is None, "reads": not self.reads}
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow([name for name in _COLUMNS if not left_out.get(name)])
        for k, name in enumerate(self.names):
            numbers = [*self.positions[k], *self.normals[k], *([] if self.depth is None else [self.depth[k]])]
            writer.writerow(
                [name, *(repr(float(one)) for one in numbers), *([" ".join(self.reads)] if self.reads else [])]
            )
        return out.getvalue()

    def replace(self, **changes: Any) -> Geometry:
        """The same with other values, as of `dataclasses.replace`."""
        return dataclasses.replace(self, **changes)

    def __len__(self) -> int:
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<Geometry of {len(self)} taxels, {'flat' if self.flat else 'curved'}, reading {', '.join(self.reads)}>"

    @property
    def flat(self) -> bool:
        """All normals are one within 1e-6, and the surface over the taxels is a plane within a millionth of its extent."""
        normal = self.normals.mean(axis=0)
        surface = self.positions + self.normals * (0.0 if self.depth is None else self.depth[:, np.newaxis])
        height = surface @ normal
        return bool(
            np.linalg.norm(self.normals - normal, axis=1).max() < 1e-6
            and np.ptp(height) <= 1e-6 * np.ptp(surface, axis=0).max()
        )

    @property
    def areas(self) -> Floats:
        """(N,): of the surface through the taxels that is nearest to each [m^2]; at the rim as if it went on."""
        return areas_of(self.positions, self.normals)

    def local_frames(self, reference: Sequence[float] = (0.0, 1.0, 0.0), frames: str = "tangent") -> Floats:
        """(N, 3, 3): rows x = -n into the pad, e_y = `reference` made tangent, e_z = x cross e_y. frames="carried":
        e_y is made tangent at the mean of the normals, and turned from there by the least rotation to each.

        Raises InputError where a normal is within 10 degrees of the reference, or of the mean's opposite: the frames would jump.
        """
        if frames == "tangent":
            return self._tangent(self.normals, reference)
        if frames != "carried":
            raise ValueError(f"frames must be tangent or carried (got {frames!r})")
        middle = self.normals.mean(axis=0)
        middle /= np.linalg.norm(middle)
        e_y = self._tangent(middle[np.newaxis], reference)[0, 1]
        x = -self.normals
        nearness = 1.0 - x @ middle
        far = np.flatnonzero(~(nearness > 1.0 - np.cos(np.radians(10.0))))
        if far.size > 0:
            raise refused(self.file, f"has a normal against the mean of all at {self.names[far[0]]}", "give the skin in parts")
        y = e_y - ((x @ e_y) / nearness)[:, np.newaxis] * (x - middle)
        return np.stack([x, y, np.cross(x, y)], axis=1)

    def _tangent(self, normals: Floats, reference: Sequence[float]) -> Floats:
        x = -normals
        along = np.asarray(reference, dtype=float)
        along = along / np.linalg.norm(along)
        y = along - (x @ along)[:, np.newaxis] * x
        length = np.linalg.norm(y, axis=1)
        near = np.flatnonzero(~(length >= np.sin(np.radians(10.0))))
        if near.size > 0:
            raise refused(
                self.file,
                f"has a normal within 10 degrees of the reference direction at {self.names[near[0]]}",
                "give reference= along the finger",
            )
        y /= length[:, np.newaxis]
        return np.stack([x, y, np.cross(x, y)], axis=1)


@dataclasses.dataclass(frozen=True, eq=False)
class Frames:
    """Readings of a sensor as its file has them, in SI: nothing is interpolated, and its rate is its own.

    Raises InputError: a shape that is not (T, N, C), times that are not (T,) or go back, a unit or frame that is not known.
    """

    readings: Floats
    """(T, N, C): frames, taxels, channels; nan where one is missing."""
    t: Floats | None = None
    """(T,): of each frame [s]; None: not known."""
    units: str = "N"
    """ "m", "N" or "Pa"; "count" of a converter's whole numbers, "T" of a magnetic field: these have no elastic model."""
    frame: str = "sensor"
    """ "sensor": components are along its x, y and z. "local": along x = -n, e_y and e_z of each taxel; one channel is x."""
    noise: float | None = None
    """One standard deviation of a reading, where the file tells: what rounding to whole counts leaves."""
    notes: tuple[str, ...] = ()
    """What was taken for granted, or left out."""
    file: str = "frames"
    """In messages."""

    def __post_init__(self) -> None:
        readings = plain(self.readings, "readings")
        if readings.ndim != 3 or 0 in readings.shape:
            raise refused(self.file, f"has readings of the shape {readings.shape}, not (frames, taxels, channels)")
        if np.isinf(readings).any():
            raise refused(self.file, "has readings that are infinite", "missing ones are nan")
        if self.units not in ("m", "N", "Pa", "count", "T") or self.frame not in ("sensor", "local"):
            raise refused(self.file, f"is in {self.units!r} along the axes {self.frame!r}", "m, N, Pa; sensor or local")
        object.__setattr__(self, "readings", readings)
        if self.t is not None:
            from ._judge import rising

            t = plain(self.t, "t")
            if t.shape != readings.shape[:1] or not np.isfinite(t).all():
                raise refused(self.file, f"has {counted(len(readings), 'frame')} and times of the shape {t.shape}")
            object.__setattr__(self, "t", t)
            object.__setattr__(self, "notes", (*self.notes, *rising(self.file, t)))

    def __len__(self) -> int:
        return len(self.readings)

    def __repr__(self) -> str:
        return (
            f"<Frames: {' x '.join(map(str, self.readings.shape))} in {self.units}, along the axes of the {self.frame}>"
        )


def read_table(where: str, most: int = MOST_BYTES) -> tuple[list[str], list[list[str]]]:
    """A CSV's header and rows as text, all of one length; blank lines and lines that begin with # are none.

    Raises InputError where it is no text, has more than `most` bytes, or rows of another length.
    """
    import os

    if os.path.getsize(where) > most:
        raise refused(where, f"has more than {most >> 20} MiB", "cut it into parts")
    try:
        with open(where, encoding="utf-8-sig", newline="") as file:
            return _table_of(where, file)
    except UnicodeDecodeError as error:
        raise refused(where, f"is no CSV: {error}", "save the table as text, with commas") from None


def _table_of(where: str, lines: Iterable[str]) -> tuple[list[str], list[list[str]]]:
    told = [line for line in lines if line.strip() and not line.startswith("#")]
    try:
        rows = [[field.strip() for field in row] for row in csv.reader(told)]
    except csv.Error as error:
        raise refused(where, f"is no CSV: {error}", "save the table as text, with commas") from None
    if len(rows) < 2:
        raise refused(where, "has no row below its header" if rows else "is empty")
    header, body = rows[0], rows[1:]
    repeated = sorted({name for name in header if header.count(name) > 1})
    if repeated:
        raise refused(where, f"has the column {repeated[0]!r} twice")
    for k, row in enumerate(body):
        if len(row) != len(header):
            raise refused(where, f"has {len(row)} fields in row {k + 1} below the header, and {len(header)} names")
    return header, body


def numbers_of(where: str, name: str, texts: Sequence[str]) -> Floats:
    """A column; an empty field is missing. Raises InputError with the row that is no number."""
    values = np.empty(len(texts))
    for k, text in enumerate(texts):
        try:
            values[k] = float(text) if text else np.nan
        except ValueError:
            raise refused(where, f"has {text!r} in the column {name}, row {k + 1}: that is no number") from None
    return values


def _triples(where: str, what: str, values: ArrayLike) -> Floats:
    array = plain(values, what)
    if array.ndim != 2 or array.shape[1] != 3:
        raise refused(where, f"has {what} of the shape {array.shape}, not (taxels, 3)")
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if wrong.size > 0:
        hint = "leave the taxel out, of its readings too, or restore its numbers"
        raise refused(where, f"has {what} that are not finite at taxel {wrong[0]}, counted from 0", hint)
    return array


def _unit(where: str, normals: Floats, names: Sequence[str]) -> Floats:
    if len(normals) != len(names):
        raise refused(where, f"has {len(names)} taxels and {len(normals)} normals")
    lengths = np.linalg.norm(normals, axis=1)
    wrong = np.flatnonzero(np.abs(lengths - 1.0) > 1e-3)
    if wrong.size > 0:
        hint = "normals are of unit length, out of the pad"
        raise refused(where, f"has a normal of length {lengths[wrong[0]]:g} at {names[wrong[0]]}", hint)
    return np.asarray(normals / lengths[:, np.newaxis])


def _check_extent(where: str, positions: Floats) -> None:
    extent = float(np.ptp(positions, axis=0).max())
    if not 1e-3 <= extent <= 1.0:
        hint = 'metres are wanted: are these millimetres? name the columns x [mm], or give tn.Geometry.load(path, unit="mm"), of points units={"length": "mm"}'
        raise refused(where, f"has taxels over {extent:g} m: from 1 mm to 1 m are possible", hint)
    order = np.lexsort(positions.T)
    same = np.flatnonzero((np.diff(positions[order], axis=0) == 0.0).all(axis=1))
    if same.size > 0:
        first, second = sorted(int(k) for k in order[same[0] : same[0] + 2])
        raise refused(
            where, f"has taxels {first} and {second} at one place", "leave one out, or average their readings"
        )


def _without_units(where: str, header: Sequence[str], unit: str | None) -> tuple[list[str], float]:
    """Names of columns without " [mm]", and the metres of that unit."""
    named, found = [], set()
    for name in header:
        bare, bracket, rest = name.partition("[")
        named.append(bare.strip())
        if bracket:
            found.add(rest.rpartition("]")[0])
    strange = sorted(set(named) - set(_COLUMNS))
    if strange:
        raise refused(where, f"has a column {strange[0]!r}: known are {', '.join(_COLUMNS)}")
    if len(found) > 1 or (found and unit is not None and unit not in found):
        raise refused(where, f"has lengths in {', '.join(sorted(found | ({unit} if unit else set())))}", "in one unit")
    chosen = next(iter(found), unit or "m")
    return named, metres(where, chosen)


def metres(where: str, unit: str) -> float:
    """Of a unit of length. Raises InputError where it is none that is known."""
    known = _core.length_units()
    if unit not in known:
        raise refused(where, f"is in {unit!r}: units of length that are known: {', '.join(known)}")
    times, over = known[unit]
    return times / over

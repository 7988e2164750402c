"""Any sensor: a CSV of taxels (name,x,y,z,nx,ny,nz,depth,reads) and a CSV of readings, a frame a row, columns QUANTITY_NAME.

The readings may name their unit, "force_x_t0 [N]", and the axes, in a first line "# points, frame sensor"; else units= and frame=
say them. Taxels are those of model=, or of NAME-taxels.csv or taxels.csv beside NAME.csv. `write` makes both files."""

from __future__ import annotations

import os
from os import PathLike, fspath

import numpy as np

from .._geometry import QUANTITIES, Frames, Geometry, numbers_of, read_table
from .._refusal import refused
from . import Given
from ._reading import header_of, si_factor, start_of, unit_given

name = "points"
refusal = ""
MARK = "# points, frame "
_MOST = 1 << 30
_SHORT = {
    f"{start}{axis}": f"{kind}_{axis}"
    for kind, starts in (("displacement", "du"), ("force", "fF"))
    for start in starts
    for axis in "xyz"
}
_TIMES = ("t", "time", "timestamp")


def sniff(path: str) -> float:
    """The mark of `write`; or names of quantities and a file of taxels beside it."""
    if start_of(path, len(MARK)).decode("latin-1") == MARK:
        return 1.0
    named = sum(_split(one)[0] != "" for one in header_of(path))
    return 0.6 if named >= 3 and _taxel_file(path) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """The file of taxels; its unit is in its header, or else given.units["length"], or metres."""
    file = given.model or _taxel_file(path)
    if not file:
        raise refused(path, "has no file of taxels beside it", "model= a CSV of name,x,y,z,nx,ny,nz,depth,reads")
    unit = given.units.get("length") if given.units is not None and not isinstance(given.units, str) else None
    return Geometry.load(file, unit=unit)


def frames(path: str, given: Given) -> Frames:
    """Readings by name, in the order of the taxels."""
    header, rows = read_table(path, _MOST)
    taxels = geometry(path, given).names
    column: dict[tuple[str, str], int] = {}
    stated = set()
    for k, text in enumerate(header):
        quantity, taxel, unit = _split(text)
        if quantity and taxel in taxels:
            column[quantity, taxel] = k
            stated.add(unit)
    quantities = list(dict.fromkeys(quantity for quantity, _ in column))
    kinds = [kind for kind, three in QUANTITIES.items() if quantities and set(quantities) <= set(three)]
    if len(kinds) != 1:
        read = ", ".join(quantities) or ", ".join(header[:6])
        raise refused(
            path, f"has the columns {read}: of one kind, displacements, forces or stresses, are known", "QUANTITY_NAME"
        )
    three = QUANTITIES[kinds[0]]
    wanted = three if len(quantities) > 1 else three[:1]
    missing = [f"{quantity}_{taxel}" for quantity in wanted for taxel in taxels if (quantity, taxel) not in column]
    if missing or set(quantities) != set(wanted):
        raise refused(
            path,
            f"has no column {missing[0] if missing else wanted[0]}",
            f"of each taxel {', '.join(three)}, or {three[0]} alone",
        )
    axes = given.frame or _axes_in(path)
    if axes is None and len(wanted) == 3 and kinds[0] != "stress":
        raise refused(path, f"does not say along which axes its {kinds[0]}s are", 'frame="sensor" or frame="local"')
    if len(stated) > 1:
        raise refused(path, f"has columns in several units: {', '.join(sorted(stated))}", "one of each file")
    unit = next(iter(stated)) or unit_given(path, given, kinds[0])
    values = np.stack(
        [
            np.stack(
                [
                    numbers_of(path, header[column[one, taxel]], [row[column[one, taxel]] for row in rows])
                    for taxel in taxels
                ],
                axis=1,
            )
            for one in wanted
        ],
        axis=2,
    )
    times = next((header.index(one) for one in _TIMES if one in header), None)
    t = None if times is None else numbers_of(path, header[times], [row[times] for row in rows])
    si = {"displacement": "m", "force": "N", "stress": "Pa"}[kinds[0]]
    return Frames(values * si_factor(path, unit, kinds[0]), t, si, axes or "local", file=path)


def write(path: str | PathLike[str], geometry: Geometry, frames: Frames) -> None:
    """PATH and PATH's name with -taxels.csv, in SI, which `tn.load(path, sensor="points", ...)` reads with nothing said."""
    from .._files import whole

    where = fspath(path)
    kind = {"m": "displacement", "N": "force", "Pa": "stress"}.get(frames.units)
    if kind is None:
        raise ValueError(f"{where}: points hold displacements, forces or stresses, and these are in {frames.units}")
    reads = QUANTITIES[kind][: frames.readings.shape[2]]
    geometry.replace(reads=reads).save(_stem(where) + "-taxels.csv")
    names = [f"{one}_{taxel} [{frames.units}]" for one in reads for taxel in geometry.names]
    rows = np.moveaxis(frames.readings, 2, 1).reshape(len(frames), -1)
    if frames.t is not None:
        names, rows = ["t", *names], np.column_stack([frames.t, rows])
    with whole(where) as to, open(to, "w", encoding="utf-8", newline="\n") as file:
        file.write(f"{MARK}{frames.frame}\n{','.join(names)}\n")
        file.writelines(",".join("" if np.isnan(one) else repr(one) for one in row) + "\n" for row in rows.tolist())


def _stem(path: str) -> str:
    return os.path.splitext(path)[0]


def _taxel_file(path: str) -> str:
    beside = (_stem(path) + "-taxels.csv", os.path.join(os.path.dirname(path), "taxels.csv"))
    return next((one for one in beside if os.path.isfile(one) and one != path), "")


def _axes_in(path: str) -> str | None:
    first = start_of(path).partition(b"\n")[0].decode("latin-1").strip()
    return first.removeprefix(MARK) if first.startswith(MARK) else None


def _split(text: str) -> tuple[str, str, str]:
    """Quantity, taxel and unit of a column's name; "": it is of no quantity."""
    bare, bracket, rest = text.partition("[")
    bare, unit = bare.strip(), rest.rpartition("]")[0].strip() if bracket else ""
    for three in QUANTITIES.values():
        for quantity in three:
            if bare.startswith(f"{quantity}_"):
                return quantity, bare[len(quantity) + 1 :], unit
    start, _, taxel = bare.partition("_")
    return (_SHORT[start], taxel, unit) if taxel and start in _SHORT else ("", "", "")

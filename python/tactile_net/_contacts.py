"""The contacts of an answer, one by one."""

from __future__ import annotations

import dataclasses
from typing import Any

__all__ = ["ContactPatch"]

Known = tuple[float, float] | None


@dataclasses.dataclass(frozen=True)
class ContactPatch:
    """One contact of an answer: each number is a value and its deviation, or None where it is not known.

    Of a line it has `normal_force`, `tangential_y_force` [N/m] and `centre_y`; all else is of skins, whose forces are in N.
    """

    id: int | None
    """Stays with a contact over the frames of a recording; None: of a single frame."""
    cells: tuple[int, ...]
    """Places that it touches: of a line values, of a skin row * columns + column."""
    normal_force: Known
    tangential_y_force: Known
    tangential_z_force: Known
    centre_y: Known
    """[m]"""
    centre_z: Known
    torsion: Known
    """Moment about the surface's normal through the centre of pressure [N m]."""
    friction: Known
    """Drag over normal force: the least friction that holds it."""
    slip_margin: Known
    """The share of the friction limit that drag and torsion leave; below 0 it slips. None without a limit."""
    extent: Known
    """Area [m^2], of a line length [m], over which the same force would press with the same sum of squares if it were
    even."""
    radius: Known
    """Of the ellipse that has the second moments of the pressure, by Hertz' law [m]."""
    second_radius: Known
    angle: Known
    """Of `radius`, from y towards z [rad]."""


def patches(rows: list[dict[str, Any]]) -> tuple[ContactPatch, ...]:
    return tuple(ContactPatch(**row) for row in rows)

"""The numbers of a result under the names that its JSON has, and what each of them is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from . import _core

__all__ = ["ContactPatch", "Key", "Told", "Uncertain", "keys"]


def parsed(text: str) -> Any:
    import json  # here, since it takes as long to import as this package does

    return json.loads(text)


class Uncertain(NamedTuple):
    """A number, and one standard deviation of it."""

    value: float
    deviation: float
    interval: Told | None = None
    """`low` and `high`, between which it lies with the probability `level`; None: only the deviation is known."""


class Told:
    """Numbers of a result as attributes, under the names that its JSON has: `result.told.network.nodes`.

    An object inside is a Told too, a list a tuple, a number with its deviation an Uncertain, and what is null is None.
    `tactile_net.keys` says what each number is; `dir` lists those that are here.
    """

    __slots__ = ("_values",)

    def __init__(self, values: dict[str, Any]) -> None:
        self._values = values

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return _told(self._values[name])
        except KeyError:
            raise AttributeError(f"there is no {name!r}: {', '.join(self._values)}") from None

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *self._values]

    def __eq__(self, other: object) -> bool:
        return self._values == other._values if isinstance(other, Told) else NotImplemented

    def __hash__(self) -> int:
        return hash(repr(self._values))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._values,)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {', '.join(self._values)}>"

    def to_dict(self) -> dict[str, Any]:
        """As JSON has it."""
        return self._values


def _is_uncertain(names: Iterable[str]) -> bool:
    return set(names) - {"interval"} == {"value", "deviation"}


def _told(value: Any) -> Any:
    if isinstance(value, dict):
        if not _is_uncertain(value):
            return Told(value)
        return Uncertain(**{name: _told(one) for name, one in value.items()})
    return tuple(map(_told, value)) if isinstance(value, list) else value


class ContactPatch(Told):
    """One contact of an answer: an attribute that a line's contact does not have is one of skins, and the other way round."""

    # keys of solve.shown.patches
    id: int
    """Stays with a contact over the frames, from 1; none is used twice."""
    normal: Uncertain
    """The normal force [N/m, of a skin N]."""
    tangential: Uncertain | None
    """Of lines. The tangential force [N/m, of a skin N]; None: it was not solved for."""
    tangential_y: Uncertain | None
    """Of skins. The tangential force along y [N/m, of a skin N]; None: it was not solved for."""
    tangential_z: Uncertain | None
    """Of skins. The tangential force along z [N/m, of a skin N]; None: it was not solved for."""
    centre: Uncertain | None | tuple[Uncertain, Uncertain]
    """Of lines. The centre of pressure [m]; None: nothing presses. Of skins. The centre of pressure, y and z [m]; None:
    nothing presses."""
    torsion: Uncertain | None
    """Of skins. The moment about x through the centre of pressure, from y towards z [N m]."""
    force: tuple[Uncertain, Uncertain, Uncertain]
    """Of skins. Of a curved skin the force that acts on it, along the sensor's x, y and z [N/m, of a skin N]; absent:
    it is flat."""
    moment: tuple[Uncertain, Uncertain, Uncertain]
    """Of skins. The moment of that force about the point that the scene names [N m]."""
    centre_in_space: tuple[Uncertain, Uncertain, Uncertain]
    """Of skins. The mean of the places of a curved skin that press, in the sensor's axes: it lies below a convex
    surface [m]; absent: nothing presses."""
    above: tuple[float, float, float]
    """Of skins. The place of the surface above that [m]."""
    friction: Uncertain | None
    """Drag over force: the least friction that holds it; None: nothing drags."""
    slip_margin: Uncertain | None
    """The share of the friction limit that drag and torsion leave; below 0 it slips; None: no limit is stated."""
    length: Uncertain | None
    """Of lines. Over which the same force would press with the same sum of squares if it were even [m]."""
    area: Uncertain | None
    """Of skins. Over which the same force would press with the same sum of squares if it were even [m^2]."""
    ellipse: Told | None
    """Of skins. By the second moments of its pressure and Hertz' law; None: they are no ellipse's."""
    # end

    cells: tuple[int, ...]
    """Places that it touches: of a line values, of a skin row * columns + column."""


def patches(text: str) -> tuple[ContactPatch, ...]:
    """Of a frame, from its JSON."""
    return tuple(map(ContactPatch, parsed(text)))


def followed_patches(text: str) -> tuple[tuple[ContactPatch, ...], ...]:
    """Of frame after frame."""
    return tuple(tuple(map(ContactPatch, rows)) for rows in parsed(text))


class Key(NamedTuple):
    """A number, or a word, of a document."""

    name: str
    """As in JSON; of one inside of an object or of a list of objects "network.nodes"."""
    unit: str
    """Empty: a ratio, a count or a word."""
    text: str
    """What it is."""


def keys(kind: str) -> tuple[Key, ...]:
    """What each number of a document is, as docs/results.md has it.

    kind: "run", "solve", "check" ..., the word that a document's own `kind` is. Raises ValueError where there is no such kind.
    Of one that a line's document has and a skin's has not, or the other way round, there is one key too.
    """
    schema = parsed(_core.schema(kind))
    return tuple(dict.fromkeys(key for form in schema.get("oneOf", [schema]) for key in _keys(form, "")))


def _keys(part: dict[str, Any], prefix: str) -> Iterator[Key]:
    for name, value in part.get("properties", {}).items():
        yield Key(prefix + name, value.get("unit", ""), value.get("description", ""))
        while "items" in value or "anyOf" in value:
            value = value.get("items") or value["anyOf"][0]
        if not _is_uncertain(value.get("properties", {})):
            yield from _keys(value, f"{prefix}{name}.")

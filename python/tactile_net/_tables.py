"""The words of a scene, as dataclasses; docs/scene.md says what each means and in which range it lies.

Nothing is checked here: they are written as TOML, and the one reader of scenes judges them.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from ._arrays import Floats

__all__ = [
    "CircularPunch",
    "Cone",
    "Contact",
    "Cylinder",
    "Ellipsoid",
    "Layer",
    "Material",
    "Noise",
    "Punch",
    "Reconstruct",
    "SampledTractions",
    "Sensor",
    "Sphere",
    "Timing",
    "TractionPatch",
    "Wedge",
    "as_table",
]

Numbers: TypeAlias = "Sequence[float] | Floats"


@dataclasses.dataclass(kw_only=True)
class Sensor:
    """[sensor]: `count` even taxels `pitch` apart, or uneven ones at `positions`; of a skin `rows` and `columns`, with a
    pitch along y and z or one for both, or a file of `taxels` with a column z, where `reads` may stand too."""

    reads: Sequence[str] | None = None
    count: int | None = None
    rows: int | None = None
    columns: int | None = None
    pitch: float | Numbers | None = None
    depth: float | Numbers | None = None
    depths: Numbers | None = None
    positions: Numbers | None = None
    taxels: str | None = None


@dataclasses.dataclass(kw_only=True)
class Layer:
    """A pad of this thickness on a rigid base, "bonded" to it or "frictionless"."""

    thickness: float
    base: str | None = None


@dataclasses.dataclass(kw_only=True)
class Material:
    """[material]: a half plane, of a skin a half space, without `layer`."""

    youngs_modulus: float
    poisson_ratio: float
    layer: Layer | None = None


@dataclasses.dataclass(kw_only=True)
class _Rigid:
    """What every rigid contact has."""

    force: float | None = None
    half_width: float | None = None
    center: float | None = None
    friction: float | None = None
    trajectory: Sequence[Mapping[str, float]] | None = None


@dataclasses.dataclass(kw_only=True)
class Cylinder(_Rigid):
    """[[contact]] of a rigid cylinder."""

    shape: str = dataclasses.field(default="cylinder", init=False)


@dataclasses.dataclass(kw_only=True)
class Punch(_Rigid):
    """[[contact]] of a flat punch, infinite at its ends unless `edge` > 0."""

    edge: float | None = None
    shape: str = dataclasses.field(default="punch", init=False)


@dataclasses.dataclass(kw_only=True)
class Wedge(_Rigid):
    """[[contact]] of a rigid wedge."""

    shape: str = dataclasses.field(default="wedge", init=False)


@dataclasses.dataclass(kw_only=True)
class SampledTractions:
    """[[contact]] given by a traction at each taxel."""

    normal: Numbers
    tangential: Numbers | None = None
    shape: str = dataclasses.field(default="tractions", init=False)


@dataclasses.dataclass(kw_only=True)
class _Body:
    """What presses on a skin: where, how hard, and how it drags."""

    force: float | None = None
    place: Numbers | None = None
    """y and z of its middle."""
    friction: float | None = None
    direction: float | None = None
    """Of the drag, in degrees from y towards z."""
    stick: float | None = None
    torsion: float | None = None
    trajectory: Sequence[Mapping[str, Any]] | None = None


@dataclasses.dataclass(kw_only=True)
class Sphere(_Body):
    """[[contact]] of a sphere on a skin; `radius` is the circle's that touches."""

    radius: float | None = None
    shape: str = dataclasses.field(default="sphere", init=False)


@dataclasses.dataclass(kw_only=True)
class Ellipsoid(_Body):
    """[[contact]] of an ellipsoid on a skin, its first radius at `angle` degrees from y towards z."""

    radii: Numbers | None = None
    angle: float | None = None
    shape: str = dataclasses.field(default="ellipsoid", init=False)


@dataclasses.dataclass(kw_only=True)
class CircularPunch(_Body):
    """[[contact]] of a flat round punch on a skin."""

    radius: float | None = None
    shape: str = dataclasses.field(default="punch", init=False)


@dataclasses.dataclass(kw_only=True)
class Cone(_Body):
    """[[contact]] of a cone on a skin."""

    radius: float | None = None
    shape: str = dataclasses.field(default="cone", init=False)


@dataclasses.dataclass(kw_only=True)
class TractionPatch:
    """[[contact]] on a skin given by tractions of rectangles `spacing` apart: lists of rows, or arrays (rows, columns)."""

    spacing: float | Numbers
    normal: Sequence[Sequence[float]] | Floats
    tangential_y: Sequence[Sequence[float]] | Floats | None = None
    tangential_z: Sequence[Sequence[float]] | Floats | None = None
    place: Numbers | None = None
    shape: str = dataclasses.field(default="tractions", init=False)


Contact = (
    Cylinder
    | Punch
    | Wedge
    | SampledTractions
    | Sphere
    | Ellipsoid
    | CircularPunch
    | Cone
    | TractionPatch
    | Mapping[str, Any]
)


@dataclasses.dataclass(kw_only=True)
class Timing:
    """[time]: frames per second, and how many."""

    rate: float
    frames: int | None = None
    duration: float | None = None


@dataclasses.dataclass(kw_only=True)
class Noise:
    """[noise]: white, of one rms for all readings or one for each quantity."""

    rms: float | Mapping[str, float]
    seed: int | None = None
    degrees: float | None = None


@dataclasses.dataclass(kw_only=True)
class Reconstruct:
    """[reconstruct]: how the tractions are found again; `alpha` is a number or the name of a rule."""

    methods: Sequence[str] | None = None
    alpha: float | str | None = None
    answer: str | None = None
    surface: str | None = None
    spacing: float | None = None
    margin: float | None = None
    smoothing_length: float | None = None
    tangential_weight: float | str | None = None
    offset: bool | None = None
    noise_gain_limit: float | None = None
    tangential: bool | None = None
    nonnegative: bool | None = None
    friction_limit: float | None = None
    alpha_on_active_set: bool | None = None
    contact_friction: float | None = None


def as_table(value: Any) -> Any:
    """A dataclass as the dictionary that it says; all else as it is."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = ((f.name, as_table(getattr(value, f.name))) for f in dataclasses.fields(value))
        return {name: inner for name, inner in fields if inner is not None}
    if isinstance(value, (list, tuple)):
        return [as_table(one) for one in value]
    if isinstance(value, Mapping):
        return {key: as_table(inner) for key, inner in value.items()}
    return value

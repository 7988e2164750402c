"""Sensors by name: their files become geometry, frames in SI, a scene, and forces with their deviations.

recording = tn.load("run/", sensor="tac3d", thickness=4e-3, youngs_modulus=50e3, poisson_ratio=0.48)
recording.solve().to_point_set("lerobot")

docs/sensors.md lists them, with what each asks for. An adapter is a module of this folder that is a `Sensor`, found by name.
"""

from __future__ import annotations

import dataclasses
import os
import pkgutil
from collections.abc import Mapping, Sequence
from importlib import import_module
from os import PathLike, fspath
from typing import Any, Protocol, cast

from .. import _core
from .._geometry import Frames, Geometry
from .._refusal import refused
from ._pad import Pad, SensorRecording
from ._point_set import PointSet

__all__ = [
    "Given",
    "Pad",
    "PointSet",
    "Sensor",
    "SensorRecording",
    "frames",
    "geometry",
    "models",
    "names",
    "refusal",
    "sniffed",
]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Given:
    """What a sensor's file does not say, and who reads it does."""

    model: str | None = None
    """The sensor's model, as its maker calls it, or a file of its geometry that the sensor's package reads."""
    name: str | None = None
    """Which of several sensors, columns, topics or arrays of the file."""
    units: str | Mapping[str, str] | None = None
    """Of its numbers: "mm", "N", "kPa"; by quantity, {"displacement": "mm", "force": "N"}."""
    reads: str | None = None
    """ "displacement", "force" or "stress", where a file may hold either."""
    frame: str | None = None
    """ "sensor" or "local": the axes of its components."""
    gain: float | Sequence[float] | None = None
    """What one count is in `units`; one number, or one a channel: a channel of the other sign has a negative one."""
    pitch: float | Sequence[float] | None = None
    """Of a flat lattice of taxels, along its rows and its columns [m]; one number: both."""


class Sensor(Protocol):
    """What a module `tactile_net.sensors.NAME` has; `path` is a file or a folder."""

    name: str
    refusal: str
    """Why there is no elastic model of what it reads; "": there is one."""

    def sniff(self, path: str) -> float:
        """0 to 1: how much the first bytes and names of files look like it. Never raises for what it cannot read."""

    def geometry(self, path: str, given: Given) -> Geometry:
        """Its taxels. Raises InputError with what to give."""

    def frames(self, path: str, given: Given) -> Frames:
        """Its readings in SI. Raises InputError with what to give."""


def names() -> tuple[str, ...]:
    """Of all sensors that are known."""
    return tuple(sorted(one.name for one in pkgutil.iter_modules(__path__) if not one.name.startswith("_")))


def adapter(name: str) -> Sensor:
    """Raises ValueError with the names that are known."""
    if name not in names():
        raise ValueError(f"there is no sensor {name!r}: known are {', '.join(names())}")
    return cast(Sensor, import_module(f"{__name__}.{name}"))


def refusal(name: str) -> str:
    """Why the sensor has no elastic model; "": it has one."""
    return adapter(name).refusal


def models(sensor: str) -> dict[str, Geometry]:
    """The taxels of each model of a sensor that are known without a file of it, as `tactile-net init --sensor` has them."""
    adapter(sensor)
    known = _core.sensor_models(sensor)
    return {model: Geometry.parse(taxels, file=f"{sensor} {model}") for model, taxels in known.items()}


def sniffed(path: str | PathLike[str]) -> dict[str, float]:
    """The sensors whose file this looks like, each with how much: above 0.5, of 1."""
    found = {name: adapter(name).sniff(fspath(path)) for name in names()}
    return {name: score for name, score in sorted(found.items(), key=lambda one: -one[1]) if score > 0.5}


def chosen(path: str, sensor: str | None) -> str:
    """The sensor that is named, or else the only one whose file this looks like. Raises InputError, FileNotFoundError."""
    if sensor is not None:
        adapter(sensor)
    os.stat(path)
    if sensor is not None:
        return sensor
    found = sniffed(path)
    if len(found) == 1:
        return next(iter(found))
    if found:
        raise refused(path, f"looks like a file of several sensors: {', '.join(found)}", "sensor= one of them")
    raise refused(path, "looks like a file of no sensor that is known", f"sensor= one of {', '.join(names())}")


def geometry(path: str | PathLike[str], sensor: str | None = None, **given: Any) -> Geometry:
    """The sensor's taxels, without a pad over them. given: the fields of `Given`. Raises InputError with what to give."""
    where, said = fspath(path), Given(**given)
    return adapter(chosen(where, sensor)).geometry(where, said)


def frames(path: str | PathLike[str], sensor: str | None = None, **given: Any) -> Frames:
    """The sensor's readings, also of one that has no elastic model. given: the fields of `Given`. Raises InputError."""
    where, said = fspath(path), Given(**given)
    return adapter(chosen(where, sensor)).frames(where, said)


def load(
    path: str | PathLike[str],
    sensor: str | None = None,
    *,
    geometry: Geometry | str | PathLike[str] | None = None,
    thickness: float | None = None,
    youngs_modulus: float | None = None,
    poisson_ratio: float | None = None,
    base: str = "bonded",
    depth: float | None = None,
    reference: Sequence[float] | None = None,
    noise: float | None = None,
    **given: Any,
) -> SensorRecording:
    """As `tactile_net.load` with a sensor."""
    where, said = fspath(path), Given(**given)
    name = chosen(where, sensor)
    one = adapter(name)
    if one.refusal:
        raise refused(
            where, f"is of the sensor {name}: {one.refusal}", f"tn.sensors.frames(path, {name!r}) gives its readings"
        )
    pad = Pad._asked(
        where,
        thickness=thickness,
        youngs_modulus=youngs_modulus,
        poisson_ratio=poisson_ratio,
        base=base,
        depth=depth,
        reference=None if reference is None else tuple(map(float, reference)),
        noise=noise,
    )
    if geometry is None:
        taxels = one.geometry(where, said)
    elif isinstance(geometry, Geometry):
        taxels = geometry
    else:
        taxels = Geometry.load(geometry)
    return SensorRecording(name, where, taxels, one.frames(where, said), pad)

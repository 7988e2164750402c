"""A sensor's frames below a pad: as a scene of the library, and solved."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping
from functools import cached_property
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .. import _core
from .._arrays import Floats
from .._geometry import QUANTITIES, Frames, Geometry
from .._layout import _unpacked
from .._recording import Recording
from .._refusal import refused
from .._skin import Skin
from ..errors import InputError

if TYPE_CHECKING:
    from .._skin_solution import SkinSolution

_DEPTHS = {"displacement": 0.15, "force": 1.0, "stress": 1.0}
"""Of the thickness, where nobody says: markers lie below the skin, cells for force and pressure on the core."""
_MOST_UNKNOWNS = 8192
"""That the library solves for where taxels lie anywhere."""
_FEW_READINGS = 768
"""Of more the default rule, aicc, finds an alpha near 0 where they are nearly as many as the unknowns; maximum likelihood holds."""
_Y = (0.0, 1.0, 0.0)
_Z = (0.0, 0.0, 1.0)
_FACES_Y = "e_y follows z, as the middle of the taxels faces y: reference= states another direction"
_CARRIED = "e_y is carried from the middle of the taxels, as the surface comes near its reference"
_ONE_CHANNEL = (
    "one channel tells of no drag: forces are those of what presses, along normals of the smooth surface through the taxels, "
    "which turn them by what they are off: 3 degrees are 5 % of the force, which no band holds"
)
_OF = {"m": "displacement", "N": "force", "Pa": "stress"}


@dataclasses.dataclass(frozen=True, kw_only=True)
class Pad:
    """The soft layer over a sensor's taxels [m, Pa]."""

    thickness: float
    poisson_ratio: float
    youngs_modulus: float | None = None
    """None: readings are forces or stresses, which do not depend on it."""
    base: str = "bonded"
    depth: float | None = None
    """Of all taxels below the surface, where their geometry does not say."""
    reference: tuple[float, ...] | None = None
    """The direction of the sensor's frame that e_y follows over the surface; None: y, or z where the middle of the taxels faces y."""
    noise: float | None = None
    """One standard deviation of a reading [m, N or Pa]; None: what the file tells, or else found from the readings."""

    @classmethod
    def _asked(cls, where: str, **values: Any) -> Pad:
        """Raises InputError that names what is missing."""
        missing = [name for name in ("thickness", "youngs_modulus", "poisson_ratio") if values[name] is None]
        if missing not in ([], ["youngs_modulus"]):
            raise refused(
                where,
                f"says nothing of the pad over its taxels: {', '.join(missing)} missing",
                "give thickness= [m], youngs_modulus= [Pa] (not needed where forces or stresses are read) and "
                "poisson_ratio= (rubber and gels: 0.48 to 0.5)",
            )
        return cls(**values)

    def _check(self, where: str, flat: bool) -> None:
        """Raises InputError that names what no pad has."""
        metres = "a length above 0 and up to 1, in metres"
        ranges = {
            "thickness": (1.0, metres),
            "depth": (1.0, metres),
            "youngs_modulus": (np.finfo(float).max, "above 0 [Pa]"),
            "noise": (np.finfo(float).max, "above 0 [m, N or Pa]"),
        }
        for name, (most, what) in ranges.items():
            value = getattr(self, name)
            if value is not None and not 0.0 < _number(value) <= most:
                raise refused(where, f"cannot have a pad of {name}={value!r}", f"{name}= {what}")
        if not 0.0 <= _number(self.poisson_ratio) <= 0.5:
            hint = "poisson_ratio= from 0 to 0.5; rubber and gels: 0.48 to 0.5"
            raise refused(where, f"cannot have a pad of poisson_ratio={self.poisson_ratio!r}", hint)
        if self.depth is not None and self.depth > self.thickness:
            hint = "depth= at most the thickness: taxels lie in the pad or on its core"
            raise refused(where, f"cannot have taxels at depth={self.depth!r} in a pad of thickness={self.thickness!r}", hint)
        if self.reference is not None and not (len(self.reference) == 3 and 0.0 < np.linalg.norm(self.reference) < np.inf):
            hint = "reference= three numbers along the sensor's x, y and z, not all 0"
            raise refused(where, f"cannot have frames along reference={self.reference!r}", hint)
        if self.base not in (("bonded", "frictionless") if flat else ("bonded",)):
            hint = 'base="bonded"' + (' or "frictionless"' if flat else ": no other is known of a curved pad")
            raise refused(where, f"cannot have a pad of base={self.base!r}", hint)


def _number(value: Any) -> float:
    """nan: it is none."""
    try:
        return np.nan if isinstance(value, str) else float(value)
    except (TypeError, ValueError):
        return np.nan


@dataclasses.dataclass(frozen=True, eq=False)
class SensorRecording:
    """What a sensor's file says, with the pad over its taxels: `tn.load(path, sensor=...)`."""

    sensor: str
    path: str
    geometry: Geometry
    frames: Frames
    pad: Pad

    def __post_init__(self) -> None:
        frames, geometry = self.frames, self.geometry
        self.pad._check(self.path, geometry.flat)
        if frames.units not in _OF:
            raise refused(
                self.path,
                "has counts of a converter" if frames.units == "count" else f"is in {frames.units}",
                'give gain= and units= of one count, as in gain=0.02, units="N"',
            )
        if frames.readings.shape[1] != len(geometry):
            raise refused(
                self.path,
                f"has readings of {frames.readings.shape[1]} taxels, and the geometry has {len(geometry)}",
                "model= or geometry= of this sensor",
            )
        channels = frames.readings.shape[2]
        if channels not in (1, 3) or (channels == 1 and frames.frame != "local"):
            raise refused(
                self.path, f"has {channels} channels along the axes of the {frames.frame}: 3, or 1 along the normal"
            )
        if self._kind == "displacement" and self.pad.youngs_modulus is None:
            raise refused(
                self.path,
                "reads displacements, which say nothing of forces without a modulus",
                "give youngs_modulus= [Pa]",
            )

    @property
    def _kind(self) -> str:
        return _OF[self.frames.units]

    def __len__(self) -> int:
        return len(self.frames)

    def __repr__(self) -> str:
        return f"<SensorRecording of {self.sensor}: {len(self)} frames of {len(self.geometry)} taxels in {self.frames.units}>"

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """What was fitted, taken for granted or left out on the way."""
        notes = [*self.geometry.notes, *self.frames.notes]
        notes += [one for one in (self._depth[1], self._frames[2]) if one]
        if self._spacing is not None:
            notes.append(
                "cells are as far apart as taxels, half a depth is too many: scene({'reconstruct.spacing': ...})"
            )
        if self.pad.youngs_modulus is None:
            notes.append("no modulus was given, nor is one needed: stresses under a layer do not depend on it")
        if self.frames.readings.shape[2] == 1 and not self.geometry.flat:
            notes.append(_ONE_CHANNEL)
        if self._kind == "force":
            areas = self.geometry.areas
            notes.append(
                "forces are stresses times the area nearest to each taxel, which is "
                f"{1e6 * areas.min():.3g} to {1e6 * areas.max():.3g} mm^2"
            )
        return tuple(notes)

    @cached_property
    def _depth(self) -> tuple[Floats, str]:
        if self.pad.depth is not None:
            return np.full(len(self.geometry), float(self.pad.depth)), ""
        if self.geometry.depth is not None:
            return self.geometry.depth, ""
        share = _DEPTHS[self._kind]
        where = "on the core" if share == 1.0 else f"{share:g} of the thickness below the surface"
        return np.full(len(self.geometry), share * self.pad.thickness), f"taxels are taken to lie {where}: give depth="

    @cached_property
    def _spacing(self) -> float | None:
        """Of the cells, where half a depth, the library's own, is too many for it; None: leave it."""
        areas, depth = self.geometry.areas, float(self._depth[0].min())
        side = np.sqrt(areas.sum()) + 2.0 * depth
        if 3.0 * (side / (0.5 * depth)) ** 2 < 0.9 * _MOST_UNKNOWNS:
            return None
        return float(f"{np.sqrt(areas.mean()):.3g}")

    @cached_property
    def _reads(self) -> tuple[tuple[str, ...], bool, dict[str, float]]:
        """Quantities as the library takes them, whether along the sensor's axes, and their noise."""
        kind = self._kind
        sensors_axes = self.frames.frame == "sensor" and kind == "displacement" and not self.geometry.flat
        noise = self.pad.noise if self.pad.noise is not None else self.frames.noise
        if kind == "force":
            noise = None if noise is None else noise / float(np.median(self.geometry.areas))
            kind = "stress"
        reads = QUANTITIES[kind][: self.frames.readings.shape[2]]
        return reads, sensors_axes, {} if noise is None else dict.fromkeys(reads, noise)

    @cached_property
    def _readings(self) -> Floats:
        """(T, N, C) of those quantities."""
        readings = self.frames.readings
        if self.frames.frame == "sensor" and not self._reads[1]:
            readings = np.einsum("nij,tnj->tni", self.local_frames, readings)
        if self._kind == "force":
            readings = readings / self.geometry.areas[np.newaxis, :, np.newaxis]
        return readings

    @cached_property
    def _frames(self) -> tuple[tuple[float, ...], str, str]:
        """What e_y follows, how, and a note: y made tangent, or carried where that is too near a normal of the surface."""
        middle = self.geometry.normals.mean(axis=0)
        faces_y = abs(middle[1]) >= np.sqrt(0.5) * np.linalg.norm(middle)
        along = (_Z if faces_y else _Y) if self.pad.reference is None else self.pad.reference
        if self.geometry.flat or self._holds(along, "tangent") or not self._holds(along, "carried"):
            return along, "tangent", _FACES_Y if faces_y and self.pad.reference is None else ""
        return along, "carried", _CARRIED

    def _holds(self, reference: tuple[float, ...], frames: str) -> bool:
        try:
            return self._parsed(self._tables(reference, frames)).surface is not None
        except ValueError:
            return False

    @cached_property
    def local_frames(self) -> Floats:
        """(N, 3, 3): rows x into the pad, e_y and e_z of each taxel, in the sensor's frame."""
        return self.geometry.local_frames(*self._frames[:2])

    @cached_property
    def _taxels(self) -> str:
        """The file of taxels: in space, or of a flat sensor in its own plane."""
        reads = self._reads[0]
        placed = self.geometry.replace(depth=self._depth[0], reads=reads)
        if not placed.flat:
            return placed.text()
        _, e_y, e_z = self.flat_frame
        places = zip(placed.names, placed.positions @ e_y, placed.positions @ e_z, self._depth[0])
        rows = (f"{name},{float(y)!r},{float(z)!r},{float(d)!r},{' '.join(reads)}" for name, y, z, d in places)
        return "\n".join(["name,y,z,depth,reads", *rows, ""])

    @property
    def flat_frame(self) -> Floats:
        """(3, 3): rows x into the pad, e_y and e_z of a flat sensor, in the sensor's frame: those of the scene."""
        return np.asarray(self.local_frames[0])

    def tables(self) -> dict[str, Any]:
        """Of the scene, as `Scene.to_dict` has them; its taxels are the file taxels.csv beside it. All is in SI."""
        return self._tables(*self._frames[:2])

    def _tables(self, reference: tuple[float, ...], frames: str) -> dict[str, Any]:
        _, sensors_axes, noise = self._reads
        pad = self.pad
        sensor: dict[str, Any] = {"taxels": "taxels.csv"}
        tables: dict[str, Any] = {
            "title": f"{self.sensor}: {os.path.basename(os.path.normpath(self.path))}",
            "units": {},
            "sensor": sensor,
            "material": {
                "youngs_modulus": _core.modulus_not_needed if pad.youngs_modulus is None else pad.youngs_modulus,
                "poisson_ratio": pad.poisson_ratio,
                "layer": {"thickness": pad.thickness, "base": pad.base},
            },
        }
        if not self.geometry.flat:
            sensor["frame"] = "sensor" if sensors_axes else "local"
            shape = {"shape": self.geometry.shape} if self.geometry.shape else {}
            tables["surface"] = shape | {"reference": list(reference), "frames": frames}
        reconstruct: dict[str, Any] = {} if self._spacing is None else {"spacing": self._spacing}
        if self.frames.readings[0].size > _FEW_READINGS:
            reconstruct["alpha"] = "evidence" if noise else "gml"
        if reconstruct:
            tables["reconstruct"] = reconstruct
        if noise:
            tables["noise"] = {"rms": noise}
        return tables

    def scene(self, changes: Mapping[str, Any] | None = None) -> Skin:
        """The scene; its readings are as of `recording`. changes: as of `Scene.replace`. Raises InputError."""
        from .._paths import replaced

        return self._parsed(replaced(self.tables(), changes or {}))

    def _parsed(self, tables: Mapping[str, Any]) -> Skin:
        from .._toml import text_of

        folder = _unpacked((("taxels.csv", self._taxels),))
        return Skin.parse(text_of(tables), file=os.path.join(folder, f"{self.sensor}.toml"))

    def recording(self, changes: Mapping[str, Any] | None = None) -> Recording:
        """The frames as readings of the scene, with its notes."""
        try:
            scene = self.scene(changes)
            _ = scene.surface
        except ValueError as error:
            # Of a surface that does not hold: in the recording's name, since the scene is made for it.
            _, of_surface, why = str(error).partition("makes cells that its surface has not: ")
            if isinstance(error, InputError) and not of_surface:
                raise
            raise refused(self.path, why.splitlines()[0] if of_surface else str(error)) from None
        reads, readings = self._reads[0], self._readings
        column = {
            f"{quantity}_{name}": readings[:, k, c]
            for c, quantity in enumerate(reads)
            for k, name in enumerate(self.geometry.names)
        }
        rows = np.stack([column[name] for name in scene.reading_names], axis=1)
        return Recording(scene, scene._framed(rows), self.frames.t, None, self.notes)

    def solve(self, changes: Mapping[str, Any] | None = None, **options: Any) -> SkinSolution:
        """Tractions and forces of each frame, with their deviations: as `Skin.solve`. changes: of the scene."""
        recording = self.recording(changes)
        if np.isnan(recording.readings).any():
            options.setdefault("missing", "estimate")
        solution = cast("SkinSolution", recording.solve(**options))
        solution.sensor = self
        return solution

    def save(self, folder: str | PathLike[str], changes: Mapping[str, Any] | None = None) -> None:
        """Writes scene.toml, taxels.csv and readings.csv, which `tactile-net solve` reads. What stands there is replaced."""
        from .._files import whole

        where = fspath(folder)
        os.makedirs(where, exist_ok=True)
        recording = self.recording(changes)
        for name, text in (("taxels.csv", self._taxels), ("scene.toml", recording.scene.text)):
            with whole(os.path.join(where, name)) as to, open(to, "w", encoding="utf-8", newline="\n") as file:
                file.write(text)
        recording.save(os.path.join(where, "readings.csv"))

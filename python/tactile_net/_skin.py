"""A scene of a skin: taxels in rows and columns, or anywhere on a surface, tractions in three directions."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from . import _core
from ._arrays import Floats, channels_first, frames_of, lattice_frames_of
from ._progress import Progress
from ._scene import _KINDS, Scene, Sites, _read_only
from ._skin_result import SkinResult
from ._skin_solution import COMPONENTS, SkinSolution
from ._solver import AnySolver

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Skin", "Surface"]


class Surface(NamedTuple):
    """The cells of a curved skin, row after row as `Skin.y` and `Skin.z` have them on its chart; in the sensor's axes."""

    middles: Floats
    """(N, 3) [m]"""
    frames: Floats
    """(N, 3, 3): unit vectors of x (into the skin), y and z at each middle, a row each."""
    areas: Floats
    """(N,) [m^2]"""
    forces: Floats
    """(N, 3, 3): what 1 Pa along each row of a cell's frames amounts to [N]."""


class Skin(Scene):
    """A Scene whose sensor is a skin, as docs/skins.md describes it. `tn.Scene` makes one wherever the sensor is a skin;
    `tn.Skin` is the same with the types of skins, and refuses line arrays.

    skin = tn.Skin(
        sensor=tn.Sensor(rows=8, columns=8, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=3e-3, friction=0.3)],
        units={},
    )
    solution = skin.simulate().solve()
    solution.normal_force, solution.torsion_deviation       # [N], [N m]

    Frames of readings are (rows, columns, C), channels last as drivers of skins give them; of taxels anywhere (R,).
    Tractions are (U, rows, columns) of the cells: p, q_y, q_z, at `y` and `z`.
    """

    _core: _core.Skin  # type: ignore[assignment]  # a skin's words are those of a line's, and more

    @property
    def count(self) -> int:
        """Taxels; those at several depths below one place count once."""
        return self.rows * self.columns

    @property
    def rows(self) -> int:
        """Of taxels, along y; where they are anywhere all of them."""
        return self._core.rows

    @property
    def columns(self) -> int:
        """Of taxels, along z; where they are anywhere 1."""
        return self._core.columns

    @property
    def reading_shape(self) -> tuple[int, ...]:
        """Of a frame: (rows, columns, C); of taxels anywhere (R,)."""
        return (self.rows, self.columns, len(self.channels)) if self.even else (self._core.readings,)

    @property
    def traction_shape(self) -> tuple[int, ...]:
        """Of one component: (rows, columns) of cells."""
        return (len(self.y), len(self.z))

    @property
    def methods(self) -> tuple[str, ...]:
        return ("tikhonov",)

    @cached_property
    def _cells(self) -> tuple[Floats, Floats, tuple[float, float]]:
        y, z, spacing = self._core.cells()
        return _read_only(y), _read_only(z), spacing

    @property
    def y(self) -> Floats:
        """(rows,): of the cells' middles [m]."""
        return self._cells[0]

    @property
    def z(self) -> Floats:
        """(columns,): of the cells' middles [m]."""
        return self._cells[1]

    @property
    def spacing(self) -> float:
        """Of `y` [m]."""
        return self._cells[2][0]

    @property
    def spacing_z(self) -> float:
        """Of `z` [m]."""
        return self._cells[2][1]

    @property
    def cell_area(self) -> float:
        """Of a cell [m^2]: its force is this times its traction."""
        return self.spacing * self.spacing_z

    @cached_property
    def surface(self) -> Surface | None:
        """The cells of a curved skin in the sensor's axes; None: the skin is flat, and `y` and `z` say where they are."""
        found = self._core.surface()
        return None if found is None else Surface(*map(_read_only, found))

    @cached_property
    def positions(self) -> Floats | None:
        """(N, 3): of a curved skin the place on its surface above each taxel, in the sensor's axes [m]; None: it is flat."""
        places = self._core.places()
        return None if places is None else _read_only(places[0])

    @cached_property
    def normals(self) -> Floats | None:
        """(N, 3): of a curved skin the outward normal there; None: it is flat."""
        places = self._core.places()
        return None if places is None else _read_only(places[1])

    @cached_property
    def taxels(self) -> Floats:
        """(N, 2): y and z of the taxels, row after row [m]; of a curved skin on its chart."""
        sites = self.sites
        places = np.empty((self.count, 2))
        places[sites.taxel] = np.stack([sites.y, sites.z], axis=1)
        return _read_only(places)

    @property
    def taxel_names(self) -> tuple[str, ...]:
        """ "3_5" of row 3 and column 5, or the name in the file of taxels."""
        return tuple(self._core.taxel_names)

    @cached_property
    def sites(self) -> Sites:
        """Where and what each reading is of, in the order of `reading_names`: channel after channel."""
        y, z, depth, quantity, taxel, channel = self._core.sites()
        return Sites(y, depth, np.array(quantity), np.array(taxel), np.array(channel), z)

    _components = COMPONENTS
    _drags = True

    @property
    def _dims(self) -> tuple[tuple[str, ...], dict[str, Any]]:
        if not self.even:
            return ("reading",), {"reading": list(self.reading_names)}
        places = self.taxels.reshape(self.rows, self.columns, 2)
        at = {"row": places[:, 0, 0], "column": places[0, :, 1]}
        return ("row", "column", "channel"), at | {"channel": list(self.channels)}

    @property
    def _surface(self) -> tuple[tuple[str, ...], dict[str, Any]]:
        return ("y", "z"), {"y": self.y, "z": self.z}

    @property
    def _places(self) -> dict[str, Floats]:
        if self.even:
            return {"y": self.taxels[:, 0], "z": self.taxels[:, 1]}
        return {"y": self.sites.y, "z": self.sites.z}

    # Frames: channels stand last in Python, and first in the library.

    def _rows(self, readings: Any, what: str = "readings") -> tuple[Floats, tuple[int, ...]]:
        return (lattice_frames_of if self.even else frames_of)(readings, self.reading_shape, what)

    def _ordered(self, frames: NDArray[Any]) -> NDArray[Any]:
        size = len(self.reading_names)
        if not self.even or frames.shape[1:] == (size,):
            return frames.reshape(len(frames), size)
        return channels_first(frames)

    def _framed(self, rows: Floats, lead: tuple[int, ...] = (-1,)) -> Floats:
        if not self.even:
            return rows.reshape(*lead, *self.reading_shape)
        frames = rows.reshape(len(rows), len(self.channels), self.rows, self.columns)
        # A frame is then memory as an estimator takes it.
        return np.ascontiguousarray(np.moveaxis(frames, 1, -1)).reshape(*lead, *self.reading_shape)

    # What it does.

    def _made_solver(self, method: str, alpha: float | None) -> AnySolver:
        _tikhonov(method)
        return _core.SkinSolver(self._core, alpha)

    def solve(
        self,
        recording: Any,
        method: str = "tikhonov",
        *,
        missing: Literal["fail", "skip", "estimate"] = "fail",
        share_alpha: int | None = None,
        progress: Progress = False,
    ) -> SkinSolution:
        """Every frame of a Recording, or of an array (..., rows, columns, C) or (..., R), with verdicts and bands.

        missing, share_alpha: as of line arrays. Taxels that never have readings are named under [dead_taxels].
        """
        _tikhonov(method)
        return SkinSolution(self._recorded(recording), method, missing, share_alpha, progress)

    def run(
        self,
        *,
        frame: int | None = None,
        compare_rules: bool = False,
        realization: str | None = None,
        progress: Progress = False,
    ) -> SkinResult:
        """As `tactile_net.run`."""
        if compare_rules:
            raise ValueError("compare_rules compares rules for line arrays, and this scene is of a skin")
        return SkinResult(self._realized(realization), frame, realization is not None, progress)


_KINDS[_core.Skin] = Skin


def _tikhonov(method: str) -> None:
    if method != "tikhonov":
        raise ValueError(f"skins are solved by tikhonov alone (got {method!r})")

"""What can be said of sensors and circuits before there is a reading."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _html
from ._arrays import Floats
from ._documents import Document, PagedDocument
from ._exchange import Exchanged
from ._optional import optional
from ._progress import Progress, listening

if TYPE_CHECKING:
    from ._scene import Scene

__all__ = ["Certification", "Relaxation", "Survey"]


class Survey(PagedDocument, Exchanged):
    """What a scene's sensors can tell, beside what others in their place could. Made by `Scene.identify`.

    Of skins `normal` and `tangential` are of waves of every direction, along each axis and all between.
    """

    scene: Scene
    normal: float | None
    """The shortest wavelength of normal traction that is told from noise [m]; None: none is."""
    tangential: float | None
    """The same of tangential traction, of skins of the drag that is told worse; None with one unknown too."""
    wavelengths: dict[str, float | None]
    """By "normal", "drag_along" the wave and, of skins, "drag_across" it: the shortest that is told from noise [m]; None: none is."""
    hides: bool
    """Whether a combination of tractions, or one of a wave, as a traction's mean, shows in no reading."""
    words: tuple[str, ...]
    """The verdict, and what to read instead, a sentence each."""

    def __init__(self, scene: Scene, traction: float | None, noise: float | None, progress: Progress = False) -> None:
        self.scene = scene
        self._options = traction, noise
        core = self._identify(progress)
        self._core = core
        self.normal, self.tangential, self.hides = core.normal, core.tangential, core.hides
        self.wavelengths = core.wavelengths()
        self.words = tuple(core.words())
        self._cells = core.cells()
        self._shares = core.shares()
        self._json = core.json()

    def _identify(self, progress: Progress = False) -> _core.Survey:
        with listening(progress) as heard:
            return _core.identify(self.scene._core, *self._options, heard)

    def _drawable(self) -> _core.Survey:
        return self._core or self._identify()

    @property
    def table(self) -> list[dict[str, str]]:
        """The scene's sensors and the alternatives, a row each, by the names of the columns."""
        return _by_column(self._cells)

    @property
    def shares(self) -> list[dict[str, str]]:
        """How many times its noise each quantity at each depth reads of one wave, of skins an oblique one, a row each."""
        return _by_column(self._shares)

    def to_xarray(self) -> Any:
        """An xarray.Dataset: `deviation` of a ripple over (wave, traction), whose `wavenumber` is over (wave, axis) and
        `wavelength` over wave (inf: the mean); `share` over (reading, traction), with `quantity` and `depth`; `shortest`
        over traction, the `wavelengths`. nan: not seen, or not solved for."""
        xarray = optional("xarray", "tables")
        told = self.to_dict()
        waves, readings = told["waves"], told["wave"]["readings"]
        parts = ["pressure", "drag_along", "drag_across"]
        deviation = np.array([[one["deviation"][part] for part in parts] for one in waves], dtype=float)
        share = np.array([[one[part] for part in parts] for one in readings], dtype=float)
        shortest = [self.wavelengths.get("normal" if part == "pressure" else part) for part in parts]
        return xarray.Dataset(
            {
                "deviation": (("wave", "traction"), deviation.reshape(-1, 3)),
                "share": (("reading", "traction"), share.reshape(-1, 3)),
                "shortest": ("traction", np.array(shortest, dtype=float)),
            },
            {
                "traction": parts,
                "axis": ["y", "z"],
                "wavenumber": (
                    ("wave", "axis"),
                    np.array([one["wavenumber"] for one in waves], dtype=float).reshape(-1, 2),
                ),
                "wavelength": ("wave", [np.inf if one["wavelength"] is None else one["wavelength"] for one in waves]),
                "quantity": ("reading", [one["quantity"] for one in readings]),
                "depth": ("reading", [one["depth"] for one in readings]),
            },
            {"scene": self.scene.text, "verdict": str(self), "noise": told["noise"], "traction": told["traction"]},
        )

    def __str__(self) -> str:
        return "\n".join(self.words)

    def _repr_html_(self) -> str:
        return _html.paragraphs(self.words) + _html.table(self._cells)


def _by_column(cells: list[list[str]]) -> list[dict[str, str]]:
    head, *rows = cells
    return [dict(zip(head, row)) for row in rows]


class Certification(PagedDocument):
    """What can be said of a scene's circuit before it is built. Made by `Scene.certify`."""

    scene: Scene
    realization: str
    stability: str
    """"stable", "unstable", "not_definite", "lossless" or "not_modelled"."""
    tolerance_margin: float | None
    """Errors of all resistors up to this, relative, are proven to leave it stable; None: nothing is proven."""
    settling_seconds: float | None
    """None: it does not settle, or nobody knows."""

    def __init__(self, scene: Scene, progress: Progress = False) -> None:
        self.scene = scene
        core = self._certify(progress)
        self._core = core
        self.realization, self.stability = core.realization, core.stability
        self.tolerance_margin, self.settling_seconds = core.tolerance_margin, core.settling_seconds
        self._text = core.text()
        self._json = core.json()

    def _certify(self, progress: Progress = False) -> _core.Certification:
        with listening(progress) as heard:
            return _core.certify(self.scene._core, heard)

    def _drawable(self) -> _core.Certification:
        return self._core or self._certify()

    def __str__(self) -> str:
        return self._text

    def _repr_html_(self) -> str:
        return _html.preformatted(self._text)


class Relaxation(Document, Exchanged):
    """What ngspice made of a scene's circuit, beside the direct solve. Made by `Scene.relax`."""

    scene: Scene
    realization: str
    voltages: Floats
    """Of the nodes [V]"""
    tractions: Floats
    """(U, M), of skins (U, rows, columns): what they stand for [Pa]"""
    y: Floats
    """Where these lie, of skins their rows [m]: network.spacing may have them farther apart than the scene's own."""
    z: Floats
    """Of skins where the columns lie [m]; of line arrays empty."""
    difference: float
    """|f - f of the direct solve| over the latter, in the 2-norm."""
    agrees: bool
    """Rounding and the op-amps explain the difference."""

    def __init__(self, scene: Scene, progress: Progress = False) -> None:
        self.scene = scene
        with listening(progress) as heard:
            core = _core.relax(scene._core, heard)
        self.realization, self.difference, self.agrees = core.realization, core.difference, core.agrees
        self.voltages = core.voltages()
        self.y, self.z = core.places()
        self.tractions = core.tractions().reshape(-1, *filter(None, (len(self.y), len(self.z))))
        self._text = core.text()
        self._json = core.json()

    def to_xarray(self) -> Any:
        """An xarray.Dataset: `tractions` over (component, y), of skins (component, y, z), and `voltages` over node."""
        xarray = optional("xarray", "tables")
        at = {"y": self.y} | ({"z": self.z} if len(self.z) > 0 else {})
        components = list(self.scene._components[: len(self.tractions)])
        return xarray.Dataset(
            {"tractions": (("component", *at), self.tractions), "voltages": ("node", self.voltages)},
            {"component": components} | at,
            {"scene": self.scene.text, "realization": self.realization, "difference": self.difference},
        )

    def __str__(self) -> str:
        return self._text

    def _repr_html_(self) -> str:
        return _html.preformatted(self._text)

"""A scene put through all that it names, and what came of it."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from . import _core, _html
from ._arrays import Floats
from ._told import ContactPatch, patches
from ._documents import PagedDocument
from ._exchange import Exchanged
from ._optional import optional
from ._progress import Progress, listening

if TYPE_CHECKING:
    from ._scene import Scene
    from ._skin import Skin
    from ._skin_result import SkinResult

__all__ = ["MethodResult", "Result", "run"]


@dataclasses.dataclass(frozen=True, eq=False)
class MethodResult:
    """One method's answer to one frame."""

    method: str
    verdict: str
    """"ok", or what is wrong with the answer; "failed": there is none, and `failure` says why."""
    tractions: Floats | None
    """(U, M) [Pa]: normal, then tangential if the method solves for it; None: no answer."""
    deviation: Floats | None
    """The same of one standard deviation; None: not known."""
    alpha: float | None
    alpha_source: str | None
    """"given", or the name of the rule that chose it."""
    force: float
    """spacing x sum of the normal traction [N/m]"""
    relative_error: float
    """|f - truth| / |truth| of the normal traction, in the 2-norm; nan without a load."""
    error_bound: float | None
    """How far rounding may have moved the answer, relative; None: no bound is known."""
    data: str | None
    """Of the readings: "ok", "noise_unknown", or why no contact can have caused them."""
    normal_force: tuple[float, float] | None
    """Value and deviation [N/m]; None: not known. So of the next two."""
    tangential_force: tuple[float, float] | None
    centre: tuple[float, float] | None
    patches: tuple[ContactPatch, ...]
    """Each contact by itself, the strongest first; none where nothing presses for certain, or nothing is known."""
    remarks: tuple[str, ...]
    """What is to be said of it, a sentence each: reasons for doubt first, then what was found in the normal course."""
    failure: str
    """Why there is no answer that holds; empty: there is one."""

    @property
    def normal(self) -> Floats:
        """(M,) [Pa]. Raises ValueError without an answer."""
        if self.tractions is None:
            raise ValueError(f"{self.method} has no answer: {self.failure}")
        return np.asarray(self.tractions[0])

    @property
    def tangential(self) -> Floats | None:
        """(M,) [Pa]; None where the method does not solve for it."""
        return self.tractions[1] if self.tractions is not None and len(self.tractions) > 1 else None


class Result(PagedDocument, Exchanged):
    """Every method's answer beside the truth. `result["tikhonov"]` is one of them."""

    scene: Scene
    frame: int | None
    truth: Floats
    """(U, M): the tractions that pressed, at `y` [Pa]."""
    readings: Floats
    """(C, N), of uneven arrays (R,): what the methods were given."""
    methods: dict[str, MethodResult]
    notes: tuple[str, ...]
    """What is to be said of the readings."""
    succeeded: bool
    """Every method has an answer that holds, and the circuit agrees with the direct solve."""

    def __init__(self, scene: Scene, frame: int | None, compare_rules: bool, progress: Progress) -> None:
        self.scene = scene
        self.frame = frame
        self._compare_rules = compare_rules
        core = self._run(False, progress)
        self._core = core
        self._drawn = False
        truth = core.truth()
        assert truth is not None, "a scene has a surface"
        self.truth = truth
        self.readings = core.readings().reshape(scene.reading_shape)
        self.methods = {}
        for answer in core.answers():
            fields = dict(answer) | {"remarks": tuple(answer["remarks"]), "patches": patches(answer["patches"])}
            self.methods[fields["method"]] = MethodResult(**fields)
        self.notes = tuple(core.notes())
        self.succeeded = core.succeeded
        self._text = core.text()
        self._json = core.json()
        self._cells = core.cells()

    def _run(self, report: bool, progress: Progress = False) -> _core.Experiment:
        with listening(progress) as heard:
            return _core.run(self.scene._core, self.frame, self._compare_rules, report, heard)

    def _drawable(self) -> _core.Experiment:
        if self._core is None or (self.scene.timing is not None and not self._drawn):
            self._core, self._drawn = self._run(True), True  # over the scene's time too
        return self._core

    def __getstate__(self) -> dict[str, Any]:
        return super().__getstate__() | {"_drawn": False}

    @property
    def y(self) -> Floats:
        """Of the tractions [m]."""
        return self.scene.y

    def __getitem__(self, method: str) -> MethodResult:
        return self.methods[method]

    def to_dataframe(self) -> Any:
        """A method a row: verdict, alpha, force, errors."""
        pandas = optional("pandas", "tables")
        names = ("verdict", "alpha", "alpha_source", "force", "relative_error", "error_bound", "data", "failure")
        rows = {name: {key: getattr(result, key) for key in names} for name, result in self.methods.items()}
        return pandas.DataFrame.from_dict(rows, orient="index", columns=list(names))

    def to_xarray(self) -> Any:
        """An xarray.Dataset: `truth` over (component, y), `tractions` over (by, component, y)."""
        xarray = optional("xarray", "tables")
        found = {name: result.tractions for name, result in self.methods.items() if result.tractions is not None}
        components = max(map(len, [self.truth, *found.values()]))
        tractions = np.full((len(found), components, len(self.y)), np.nan)
        for row, values in zip(tractions, found.values()):
            row[: len(values)] = values
        truth = np.zeros((components, len(self.y)))
        truth[: len(self.truth)] = self.truth
        return xarray.Dataset(
            {"truth": (("component", "y"), truth), "tractions": (("by", "component", "y"), tractions)},
            {"by": list(found), "component": ["normal", "tangential"][:components], "y": self.y},
            {"scene": self.scene.text},
        )

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return "<Result: " + ", ".join(f"{name} {result.verdict}" for name, result in self.methods.items()) + ">"

    def _repr_html_(self) -> str:
        found = [(name, result.tractions[0]) for name, result in self.methods.items() if result.tractions is not None]
        return _html.table(self._cells) + _html.curves(self.y, [("truth", self.truth[0]), *found])


@overload
def run(
    scene: Skin,
    *,
    frame: int | None = None,
    compare_rules: bool = False,
    realization: str | None = None,
    progress: Progress = False,
) -> SkinResult: ...
@overload
def run(
    scene: Scene,
    *,
    frame: int | None = None,
    compare_rules: bool = False,
    realization: str | None = None,
    progress: Progress = False,
) -> Result: ...
def run(
    scene: Scene,
    *,
    frame: int | None = None,
    compare_rules: bool = False,
    realization: str | None = None,
    progress: Progress = False,
) -> Result:
    """Simulates the scene, solves it by every method that it names, and compares.

    frame: which of a scene with [time]; None: the last. compare_rules: all rules for alpha, though one would do.
    realization: of the circuit, which is then among the methods: "lattice", "nic", ...
    A method that cannot take the scene is a result that says so. Circuits are run by ngspice, where it is installed.
    """
    return scene.run(frame=frame, compare_rules=compare_rules, realization=realization, progress=progress)

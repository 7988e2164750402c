"""A skin's scene put through all that it names, and what came of it."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _html
from ._arrays import Floats
from ._told import patches
from ._optional import optional
from ._progress import Progress, listening
from ._result import MethodResult, Result
from ._skin_solution import COMPONENTS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._skin import Skin

__all__ = ["SkinMethodResult", "SkinResult"]

Known = tuple[float, float] | None


@dataclasses.dataclass(frozen=True, eq=False)
class SkinMethodResult(MethodResult):
    """One frame's answer: `tractions` and `deviation` are (U, rows, columns), forces in N.

    `tangential_force` and `centre` have two directions here, and are None: see `tangential_y_force`, `centre_y`, ...
    """

    tangential_y_force: Known
    """Value and deviation [N]; None: not known. So of all that follow."""
    tangential_z_force: Known
    centre_y: Known
    """[m]"""
    centre_z: Known
    torsion: Known
    """Moment about the surface's normal through the centre of pressure [N m]."""
    friction: Known
    """Drag over normal force."""
    relative_errors: tuple[float, float, float]
    """Of p, q_y and q_z: |f - truth| over |true p|, in the 2-norm; nan where one was not solved for."""
    touching: NDArray[np.bool_]
    """(rows, columns): the cells that a contact covers."""
    contacts: int
    """How many lie apart."""


class SkinResult(Result):
    """The answer beside the truth: (U, rows, columns) each. `result["tikhonov"]` is a SkinMethodResult; so is
    `result["network"]`, the circuit in ngspice, where `tn.run` is told a realization."""

    scene: Skin

    def __init__(self, scene: Skin, frame: int | None, with_circuit: bool, progress: Progress) -> None:
        self.scene = scene
        self.frame = frame
        self._with_circuit = with_circuit
        core = self._run_skin(progress)
        self._core: Any = core
        truth = core.truth()
        assert truth is not None, "a scene has a surface"
        self.truth = truth
        self.readings = scene._framed(core.readings().reshape(1, -1), ())
        self.notes = ()
        self.succeeded = core.succeeded
        self._text = core.text()
        self._json = core.json()
        self.methods: dict[str, MethodResult] = {}
        for answer in core.answers():
            remarks = tuple(answer["remarks"])
            if answer["method"] == "tikhonov":  # what is said of the readings is said of their answer
                remarks = (*core.notes(), *remarks)
            found = {"remarks": remarks, "patches": patches(answer["patches"]), "touching": answer["touching"] != 0.0}
            self.methods[answer["method"]] = SkinMethodResult(**(dict(answer) | found))
        skin = self.methods["tikhonov"]
        assert isinstance(skin, SkinMethodResult)
        self.skin = skin
        """The answer, with the types of skins."""

    def _run_skin(self, progress: Progress = False) -> _core.Experiment:
        with listening(progress) as heard:
            return _core.run_skin(self.scene._core, self.frame, self._with_circuit, heard)

    def _drawable(self) -> Any:
        if self._core is None:  # it was pickled, as arrays
            self._core = self._run_skin()
        return self._core

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_core": None}

    def to_xarray(self) -> Any:
        """An xarray.Dataset: `truth`, `tractions` and `deviation` over (component, y, z), `touching` over (y, z)."""
        xarray = optional("xarray", "tables")
        answer, scene = self.skin, self.scene
        if answer.tractions is None or answer.deviation is None:
            raise ValueError(f"there is no answer: {answer.failure}")
        held = {"truth": self.truth[: len(answer.tractions)], "tractions": answer.tractions}
        variables: dict[str, Any] = {
            name: (("component", "y", "z"), values) for name, values in (held | {"deviation": answer.deviation}).items()
        }
        return xarray.Dataset(
            variables | {"touching": (("y", "z"), answer.touching)},
            {"component": list(COMPONENTS[: len(answer.tractions)]), "y": scene.y, "z": scene.z},
            {"scene": scene.text},
        )

    def _repr_html_(self) -> str:
        return _html.page(self._drawable().html())

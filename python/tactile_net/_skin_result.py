"""A skin's scene put through all that it names, and what came of it."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _html
from ._arrays import Floats
from ._contacts import patches
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
        self.truth = core.truth().reshape(3, *scene.traction_shape)
        self.readings = scene._framed(core.readings().reshape(1, -1), ())
        self.notes = ()
        self.succeeded = core.succeeded
        self._text = core.text()
        self._json = core.json()
        self.skin = _answer(core, scene)
        """The answer, with the types of skins."""
        self.methods: dict[str, MethodResult] = {"tikhonov": self.skin}
        if (circuit := core.network()) is not None:
            self.methods["network"] = _by_circuit(circuit, scene)

    def _run_skin(self, progress: Progress = False) -> _core.SkinExperiment:
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


def _unknown(scene: Skin) -> dict[str, Any]:
    """What is not known of an answer where nothing else is said."""
    return {
        "tractions": None,
        "deviation": None,
        "alpha": None,
        "alpha_source": None,
        "force": float("nan"),
        "relative_error": float("nan"),
        "error_bound": None,
        "data": None,
        "normal_force": None,
        "tangential_force": None,
        "centre": None,
        "patches": (),
        "remarks": (),
        "failure": "",
        "tangential_y_force": None,
        "tangential_z_force": None,
        "centre_y": None,
        "centre_z": None,
        "torsion": None,
        "friction": None,
        "touching": np.zeros(scene.traction_shape, dtype=np.bool_),
        "contacts": 0,
    }


def _answer(core: _core.SkinExperiment, scene: Skin) -> SkinMethodResult:
    found, places = core.fields(), scene.traction_shape
    remarks, relative = tuple(core.remarks()), tuple(map(float, core.relative()))
    known: dict[str, Any] = _unknown(scene) | {"remarks": remarks, "relative_errors": relative}
    if len(found["alpha"]) == 0:
        return SkinMethodResult(**known | {"method": "tikhonov", "verdict": "failed", "failure": core.refusal})
    wrench = dict(zip(_core.wrench_columns()[0:14:2], map(_known, found["wrench"][0, :14].reshape(-1, 2))))
    force = wrench["normal"]
    known |= {
        "method": "tikhonov",
        "verdict": found["verdict"][0],
        "tractions": found["tractions"].reshape(-1, *places),
        "deviation": found["deviation"].reshape(-1, *places),
        "alpha": float(found["alpha"][0]),
        "alpha_source": found["alpha_source"][0],
        "force": float("nan") if force is None else force[0],
        "relative_error": relative[0],
        "data": found["data"][0],
        "normal_force": force,
        "failure": "no answer that holds" if found["verdict"][0] == "failed" else "",
        "tangential_y_force": wrench["tangential_y"],
        "tangential_z_force": wrench["tangential_z"],
        "patches": patches(core.patches()),
        "touching": found["touching"].reshape(places) != 0.0,
        "contacts": int(found["contacts"][0]),
    }
    return SkinMethodResult(**known | {key: wrench[key] for key in ("centre_y", "centre_z", "torsion", "friction")})


def _by_circuit(found: dict[str, Any], scene: Skin) -> SkinMethodResult:
    """The circuit's answer: tractions of its nodes, which network.spacing may have in larger cells."""
    known = _unknown(scene)
    relative = tuple(map(float, found["relative"]))
    if found["tractions"] is not None:
        tractions = found["tractions"].reshape(found["shape"])
        known |= {"tractions": tractions, "force": found["cell_area"] * float(tractions[0].sum())}
    return SkinMethodResult(
        **known
        | {key: found[key] for key in ("verdict", "failure", "alpha", "alpha_source", "error_bound")}
        | {"method": "network", "relative_error": relative[0], "relative_errors": relative}
    )


def _known(pair: Floats) -> Known:
    return None if np.isnan(pair[0]) else (float(pair[0]), float(pair[1]))

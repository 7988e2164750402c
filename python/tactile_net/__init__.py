"""Surface tractions from sensors buried in a soft pad.

scene = tn.Scene.load("pad.toml")
solution = scene.read("mine.csv").solve()

docs/python.md has it all; docs/scene.md says what a scene is. All numbers are in SI where a scene states its units, and
else in those of the scene; arrays are float64.
"""

from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from . import datasets, errors, plot, sensors
from ._calibration import Calibration, FittedValue, NextPress, calibrate
from ._check import Finding, ReadingsCheck
from ._circuit import Certification, Relaxation, Survey
from ._controller import ContactEstimate, ContactRow, Estimator, Plan
from ._core import version as __version__
from ._files import load
from ._geometry import Frames, Geometry
from ._optional import part
from ._recording import Distribution, Recording, Solution
from ._report import Report, report
from ._result import MethodResult, Result, run
from ._scene import Scene, Sites
from ._skin import Skin, Surface
from ._skin_result import SkinMethodResult, SkinResult
from ._skin_solution import SkinSolution
from ._solver import Solver
from ._sweep import Study, SweepTable, merge, sweep
from ._tables import (
    CircularPunch,
    Cone,
    Contact,
    Cylinder,
    Ellipsoid,
    Layer,
    Material,
    Noise,
    Punch,
    Reconstruct,
    SampledTractions,
    Sensor,
    Sphere,
    Timing,
    TractionPatch,
    Wedge,
)
from ._told import ContactPatch, Key, Told, Uncertain, keys
from .errors import CutOffWarning, Diagnostic, FrameError, InputError, SimulatorError, UnsolvableError

if TYPE_CHECKING:
    from . import logs, mujoco

__all__ = [
    "Calibration",
    "Certification",
    "CircularPunch",
    "Cone",
    "Contact",
    "ContactEstimate",
    "ContactPatch",
    "ContactRow",
    "CutOffWarning",
    "Cylinder",
    "Diagnostic",
    "Distribution",
    "Ellipsoid",
    "Estimator",
    "Finding",
    "FittedValue",
    "FrameError",
    "Frames",
    "Geometry",
    "InputError",
    "Key",
    "Layer",
    "Material",
    "MethodResult",
    "NextPress",
    "Noise",
    "Plan",
    "Punch",
    "ReadingsCheck",
    "Reconstruct",
    "Recording",
    "Relaxation",
    "Report",
    "Result",
    "SampledTractions",
    "Scene",
    "Sensor",
    "SimulatorError",
    "Sites",
    "Skin",
    "SkinMethodResult",
    "SkinResult",
    "SkinSolution",
    "Solution",
    "Solver",
    "Sphere",
    "Study",
    "Surface",
    "Survey",
    "SweepTable",
    "Timing",
    "Told",
    "TractionPatch",
    "Uncertain",
    "UnsolvableError",
    "Wedge",
    "__version__",
    "calibrate",
    "datasets",
    "errors",
    "keys",
    "load",
    "logs",
    "merge",
    "mujoco",
    "plot",
    "report",
    "run",
    "sensors",
    "sweep",
]

_PARTS = ("logs", "mujoco")
"""Which a wheel may be built without (python/logs, python/mujoco)."""
for _part in _PARTS:
    if find_spec(f"{__name__}.{_part}") is None:
        __all__.remove(_part)


def __getattr__(name: str) -> Any:
    """A part, when it is first asked for."""
    if name not in _PARTS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        return part(name)
    except ImportError as error:
        raise AttributeError(str(error)) from error

"""Surface tractions from sensors buried in a soft pad.

scene = tn.Scene.load("pad.toml")
solution = scene.read("mine.csv").solve()

docs/python.md has it all; docs/scene.md says what a scene is. All numbers are in SI where a scene states its units, and
else in those of the scene; arrays are float64.
"""

from . import errors, logs, mujoco, plot
from ._circuit import Certification, Relaxation, Survey
from ._controller import ContactEstimate, Estimator, Plan
from ._core import version as __version__
from ._files import load
from ._recording import Recording, Solution
from ._result import MethodResult, Result, run
from ._scene import Scene, Sites, Solver
from ._sweep import Study, SweepTable, merge, slurm_script, sweep
from ._tables import (
    Contact,
    Cylinder,
    Layer,
    Material,
    Noise,
    Punch,
    Reconstruct,
    SampledTractions,
    Sensor,
    Timing,
    Wedge,
)
from .errors import CutOffWarning, Diagnostic, FrameError, InputError, SimulatorError, UnsolvableError

__all__ = [
    "Certification",
    "Contact",
    "ContactEstimate",
    "CutOffWarning",
    "Cylinder",
    "Diagnostic",
    "Estimator",
    "FrameError",
    "InputError",
    "Layer",
    "Material",
    "MethodResult",
    "Noise",
    "Plan",
    "Punch",
    "Reconstruct",
    "Recording",
    "Relaxation",
    "Result",
    "SampledTractions",
    "Scene",
    "Sensor",
    "SimulatorError",
    "Sites",
    "Solution",
    "Solver",
    "Study",
    "Survey",
    "SweepTable",
    "Timing",
    "UnsolvableError",
    "Wedge",
    "__version__",
    "errors",
    "load",
    "logs",
    "merge",
    "mujoco",
    "plot",
    "run",
    "slurm_script",
    "sweep",
]

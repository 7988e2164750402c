"""A method of a scene for any number of frames, and what learning asks of it."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

import numpy as np

from . import _core
from ._arrays import Floats, frames_of

if TYPE_CHECKING:
    from ._recording import Solution
    from ._scene import Scene

__all__ = ["Solver"]

AnySolver: TypeAlias = "_core.Solver | _core.SkinSolver"


class Solver:
    """A method of a scene, made ready: readings in, tractions out. Made by `Scene.solver`.

    Its answers are of one alpha, where those of `Scene.solve` may be of all that the readings leave possible.
    """

    def __init__(self, scene: Scene, method: str, alpha: float | None) -> None:
        self.scene = scene
        self.method = method
        self.alpha = alpha
        """For every frame; None: the scene's, or each frame's by its rule."""
        self._core = scene._made_solver(method, alpha)

    @property
    def _shape(self) -> tuple[int, ...]:
        """Of the tractions of one frame."""
        places = self.scene.traction_shape
        return self._core.tractions // math.prod(places), *places

    @overload
    def __call__(self, readings: Any, *, full: Literal[False] = False) -> Floats: ...
    @overload
    def __call__(self, readings: Any, *, full: Literal[True]) -> tuple[Floats, Solution]: ...
    def __call__(self, readings: Any, *, full: bool = False) -> Floats | tuple[Floats, Solution]:
        """(..., C, N) or (..., C*N) readings, of uneven arrays (..., R), to (..., U, M) tractions [Pa].

        full: also the Solution, with verdicts, bands and notes of every frame, one after another.
        Raises FrameError for a frame that is not finite.
        """
        rows, lead = self.scene._rows(readings)
        if not full:
            return self._core.solve(rows).reshape(*lead, *self._shape)
        scene = self.scene if self.alpha is None else self.scene.replace({"reconstruct.alpha": self.alpha})
        solution = scene.solve(rows, self.method)
        return solution.tractions.reshape(*lead, *solution.tractions.shape[1:]), solution

    @property
    def matrix(self) -> Floats:
        """M: tractions are M g. (U*M, R), read-only: the solver's own memory, which is not copied.

        Raises ValueError where the answer is not one product: alpha by a rule, constraints, dft, 1024 tractions and more.
        """
        return self._core.matrix

    def vjp(self, gradient: Any) -> Floats:
        """(..., U, M), what a loss changes by with each traction, to (..., C, N): with each reading. M' gradient."""
        rows, lead = frames_of(gradient, self._shape, "gradient")
        return np.asarray(self.scene._framed(rows @ self.matrix, lead))

    def alpha_derivative(self, readings: Any) -> Floats:
        """(..., C, N) readings to (..., U, M): what the tractions change by with log(alpha) [Pa].

        With P = (WK)'(WK) + alpha L'L it is -alpha P^-1 L'L f, and that is the method, less what it makes of its own
        tractions' readings: -M (g - K f).
        """
        matrix = self.matrix
        rows, lead = self.scene._rows(readings)
        tractions = rows @ matrix.T
        left = rows - tractions @ self._kernel.T
        return np.asarray((left @ -matrix.T).reshape(*lead, *self._shape))

    @cached_property
    def _kernel(self) -> Floats:
        return self.scene.kernel_matrix()

    def __reduce__(self) -> tuple[Any, ...]:
        return Solver, (self.scene, self.method, self.alpha)

    def __repr__(self) -> str:
        return f"<Solver {self.method} of {self.scene.file}>"

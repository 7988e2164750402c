"""Depth, layer, moduli and gains from a log of presses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from . import _core, _html
from ._documents import PagedDocument
from ._progress import Progress, listening
from ._scene import Scene

__all__ = ["Calibration", "FittedValue", "NextPress", "calibrate"]


@dataclass(frozen=True)
class FittedValue:
    """A value that a log of presses was asked for."""

    value: float
    sd: float | None
    """One standard deviation; None: nothing is known of it."""
    verdict: str
    """"identified", "weak", "prior_only", "not_identifiable", "at_bound" or "fixed"."""
    nominal: float | None = None
    """What the scene states; None of gains and offsets."""
    prior_sd: float | None = None
    """Of what the scene states; None: unknown."""


@dataclass(frozen=True)
class NextPress:
    """A press to do next."""

    position: float
    """Of its middle along y [m]; 0 is the middle of a line."""
    radius: float | None
    """Of the rod, on a skin of the ball [m]; None: a punch or a cone."""
    half_width: float
    """Of its contact under `force` [m]."""
    force: float
    """[N/m], on a skin [N]"""
    unknown_then: float
    """Share of the readings, or of the target, that is unknown once this and those before are done; of a shift its deviation [m]."""
    shape: str = "cylinder"
    """On a skin "sphere", "punch" or "cone"."""
    position_z: float | None = None
    """On a skin [m]."""


class Calibration(PagedDocument):
    """What a log of presses says of a scene: values, deviations, verdicts. Made by `calibrate`.

    In SI where the scene states units; gains and offsets as in the table [calibration] of the scene that `write` writes:
    number = gain * reading + offset.
    """

    scene: Scene
    """The nominal one."""
    verdict: str
    """Of the fit: "ok", "poor_fit" or "iteration_limit"."""
    rms: float
    """Of the residuals over the noise: 1 where the presses are explained."""
    parameters: dict[str, FittedValue]
    """"depth", "thickness", "poisson_ratio", "youngs_modulus", "crosstalk", "shift", "pitch", of a skin "shift_z"; no thickness without a layer."""
    mean_gains: dict[str, FittedValue]
    """Of each channel, over the nominal scene's."""
    gains: tuple[FittedValue, ...]
    """Of each reading, channel after channel."""
    offsets: tuple[FittedValue, ...]
    """Of each reading, channel after channel."""
    hidden: tuple[str, ...]
    """What the log cannot tell, a sentence each."""
    null_directions: tuple[dict[str, Any], ...]
    """The same as vectors: "text", "parameters" and "gains"."""
    next: tuple[NextPress, ...]
    """The presses to do next, where they were asked for."""
    words: tuple[str, ...]
    """Whether the fit holds, and what stands out, a sentence each."""
    notes: tuple[str, ...]
    """What is odd about the log and not wrong."""

    def __init__(self, scene: Scene, log: str, options: tuple[bool, int, str | None, list[str]], progress: Progress = False) -> None:
        self.scene = scene
        self._log, self._options = log, options
        core = self._calibrate(progress)
        self._core = core
        self._json = core.json()
        document = self.to_dict()
        self.verdict, self.rms = document["fit"]["verdict"], document["fit"]["rms"]
        self.parameters = {name: FittedValue(**value) for name, value in document["parameters"].items() if value}
        self.mean_gains = {name: FittedValue(**value) for name, value in document["mean_gains"].items()}
        self.gains = tuple(_listed(value) for value in document["gains"])
        self.offsets = tuple(_listed(value) for value in document["offsets"])
        self.null_directions = tuple(document["null_directions"])
        self.next = tuple(
            NextPress(**{key: press.get(key) for key in NextPress.__dataclass_fields__}) for press in document["next"]
        )
        self.words, self.hidden = tuple(core.words()), tuple(core.hidden())
        self.notes = tuple(core.notes)
        self._cells, self._next_cells = core.cells(), core.next_cells()

    def _calibrate(self, progress: Progress = False) -> _core.Calibration:
        with listening(progress) as heard:
            return _core.calibrate(self.scene._core, self._log, *self._options, heard)

    def _drawable(self) -> _core.Calibration:
        return self._core or self._calibrate()

    def write(self, path: str | PathLike[str], *, force: bool = False) -> Scene:
        """Writes the nominal scene's file again with what was found in it, and returns that scene.

        Raises UnsolvableError where the fit is not "ok", unless `force`.
        """
        self._core = self._drawable()
        text = self._core.calibrated(force)
        Path(path).write_bytes(text.encode())
        return Scene.load(path)

    def page(self, path: str | PathLike[str]) -> str:
        """Writes the page alone, without the files beside it that `report` writes; returns its path."""
        self._core = self._drawable()
        Path(path).write_bytes(self._core.html().encode())
        return fspath(path)

    @property
    def table(self) -> list[dict[str, str]]:
        """The parameters as the command prints them, a row each, by the names of the columns."""
        head, *rows = self._cells
        return [dict(zip(head, row)) for row in rows]

    def __str__(self) -> str:
        return "\n".join((*self.words, *self.hidden))

    def _repr_html_(self) -> str:
        planned = _html.table(self._next_cells) if self.next else ""
        return _html.table(self._cells) + _html.paragraphs((*self.words, *self.hidden)) + planned


def _listed(value: dict[str, Any]) -> FittedValue:
    return FittedValue(value["value"], value["sd"], value["verdict"])


def calibrate(
    log: str | PathLike[str],
    scene: Scene | str | PathLike[str],
    *,
    robust: bool = False,
    next: int = 0,
    target: str | None = None,
    fixed: Sequence[str] = (),
    progress: Progress = False,
) -> Calibration:
    """Depth, thickness, moduli, gains and offsets from a log of presses, as the command `calibrate` finds them.

    log: a CSV file, a row a press (docs/calibration.md). scene: the nominal one; its table [calibrate] says how well it is
    known; of a skin too. robust: outlying readings, forces and positions count less. next: how many presses to plan; target: the
    parameter that they are to tell, None: readings. fixed: parameters that are exact as the scene states them.
    Raises InputError with every problem of the log, ValueError where it cannot belong to the scene.
    """
    nominal = scene if isinstance(scene, Scene) else Scene.load(scene)
    return Calibration(nominal, fspath(log), (robust, next, target, list(fixed)), progress)

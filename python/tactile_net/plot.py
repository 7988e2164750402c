"""Pictures with matplotlib, which is imported when the first is drawn. Each returns its Axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._optional import optional
from ._recording import Recording, Solution
from ._result import Result

__all__ = ["readings", "result", "tractions", "over_time"]


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    return optional("matplotlib.pyplot", "plot").subplots(figsize=(7, 3.5), layout="constrained")[1]


def _surface(ax: Any) -> Any:
    ax.axhline(0.0, color="0.8", linewidth=1)
    ax.set_xlabel("y [mm]")
    ax.set_ylabel("traction [kPa]")
    ax.legend(frameon=False)
    return ax


def readings(recording: Recording, frame: int = -1, ax: Any = None) -> Any:
    """One frame of readings over the taxels."""
    ax = _axes(ax)
    sites = recording.scene.sites
    values = recording.readings[frame].reshape(-1)
    for number, channel in enumerate(recording.scene.channels):
        of = sites.channel == number
        ax.plot(1e3 * sites.y[of], values[of], ".-", label=channel)
    ax.set_xlabel("y [mm]")
    ax.set_ylabel("reading")
    ax.legend(frameon=False)
    return ax


def result(result: Result, ax: Any = None) -> Any:
    """The truth, and every method's answer with its band of two deviations."""
    ax = _axes(ax)
    y = 1e3 * result.y
    for name, truth in zip(("normal", "tangential"), result.truth):
        ax.plot(y, 1e-3 * truth, color="0.6", linewidth=3, label=f"truth, {name}")
    for name, answer in result.methods.items():
        if answer.tractions is not None:
            _answers(ax, y, name, answer.tractions, answer.deviation)
    return _surface(ax)


def tractions(solution: Solution, frame: int | None = None, ax: Any = None) -> Any:
    """One frame's tractions with bands of two deviations; None: of the frame that presses hardest."""
    ax = _axes(ax)
    frame = solution.peak if frame is None else frame
    deviation = solution.deviation[frame] if solution.has_bands else None
    _answers(ax, 1e3 * solution.y, f"frame {frame}", solution.tractions[frame], deviation)
    return _surface(ax)


def over_time(solution: Solution, ax: Any = None) -> Any:
    """Normal tractions over y and time, blue presses, red pulls."""
    ax = _axes(ax)
    t = np.arange(len(solution)) if solution.t is None else solution.t
    normal = 1e-3 * solution.tractions[:, 0].T
    largest = float(np.nanmax(np.abs(normal), initial=0.0)) or 1.0
    mesh = ax.pcolormesh(t, 1e3 * solution.y, normal, cmap="RdBu", vmin=-largest, vmax=largest, shading="nearest")
    ax.figure.colorbar(mesh, ax=ax, label="pressure [kPa]")
    ax.set_xlabel("frame" if solution.t is None else "t [s]")
    ax.set_ylabel("y [mm]")
    return ax


def _answers(ax: Any, y: Any, name: str, values: Any, deviation: Any) -> None:
    for i, component in enumerate(("normal", "tangential")[: len(values)]):
        (line,) = ax.plot(y, 1e-3 * values[i], label=f"{name}, {component}")
        if deviation is not None:
            low, high = values[i] - 2 * deviation[i], values[i] + 2 * deviation[i]
            ax.fill_between(y, 1e-3 * low, 1e-3 * high, color=line.get_color(), alpha=0.2, linewidth=0)

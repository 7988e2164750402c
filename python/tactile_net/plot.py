"""Pictures with matplotlib, which is imported when the first is drawn. Each returns its Axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._optional import optional
from ._recording import Recording, Solution
from ._result import Result
from ._scene import Scene
from ._skin import Skin
from ._skin_result import SkinResult
from ._skin_solution import SkinSolution

__all__ = ["over_time", "pressure_map", "readings", "result", "tractions"]


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
    """One frame of readings over the taxels; of a skin its first channel as a map."""
    if isinstance(recording.scene, Skin):
        return _reading_map(recording.scene, recording.readings[frame], ax)
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
    """The truth, and every method's answer with its band of two deviations; of a skin the answer as a map."""
    if isinstance(result, SkinResult):
        if result.skin.tractions is None:
            raise ValueError(f"there is no answer: {result.skin.failure}")
        return pressure_map(result.scene, result.skin.tractions, result.skin.touching, ax=ax)
    ax = _axes(ax)
    y = 1e3 * result.y
    for name, truth in zip(("normal", "tangential"), result.truth):
        ax.plot(y, 1e-3 * truth, color="0.6", linewidth=3, label=f"truth, {name}")
    for name, answer in result.methods.items():
        if answer.tractions is not None:
            _answers(ax, y, name, answer.tractions, answer.deviation)
    return _surface(ax)


def tractions(solution: Solution, frame: int | None = None, ax: Any = None) -> Any:
    """One frame's tractions with bands of two deviations, of a skin as a map; None: of the frame that presses hardest."""
    frame = solution.peak if frame is None else frame
    if isinstance(solution, SkinSolution):
        return pressure_map(solution.scene, solution.tractions[frame], solution.touching[frame], ax=ax)
    ax = _axes(ax)
    deviation = solution.deviation[frame] if solution.has_bands else None
    _answers(ax, 1e3 * solution.y, f"frame {frame}", solution.tractions[frame], deviation)
    return _surface(ax)


def over_time(solution: Solution, ax: Any = None) -> Any:
    """Normal tractions over y and time, blue presses, red pulls; of a skin its forces with bands of two deviations, of its
    mixture with 95 % intervals."""
    if isinstance(solution, SkinSolution):
        return _forces(solution, _axes(ax))
    ax = _axes(ax)
    t = np.arange(len(solution)) if solution.t is None else solution.t
    normal = 1e-3 * solution.tractions[:, 0].T
    largest = float(np.nanmax(np.abs(normal), initial=0.0)) or 1.0
    mesh = ax.pcolormesh(t, 1e3 * solution.y, normal, cmap="RdBu", vmin=-largest, vmax=largest, shading="nearest")
    ax.figure.colorbar(mesh, ax=ax, label="pressure [kPa]")
    ax.set_xlabel("frame" if solution.t is None else "t [s]")
    ax.set_ylabel("y [mm]")
    return ax


def pressure_map(scene: Scene, tractions: Any, touching: Any = None, *, ax: Any = None, largest: float | None = None) -> Any:
    """A skin's tractions (U, rows, columns) as seen from outside: colours are the pressure, arrows the drag.

    y runs to the right, z downwards. Blue presses, red pulls.
    touching: (rows, columns), cells that a contact covers, which are outlined. largest: of the colours [Pa]; None: of p.
    """
    if not isinstance(scene, Skin):
        raise ValueError("pressure_map is of skins: tactile_net.plot.tractions draws line arrays")
    ax = _square(ax)
    y, z = 1e3 * scene.y, 1e3 * scene.z
    p = 1e-3 * np.asarray(tractions[0])
    top = 1e-3 * largest if largest is not None else float(np.nanmax(np.abs(p), initial=0.0)) or 1.0
    pulls = float(np.nanmin(p, initial=0.0)) < -0.05 * top
    colours = {"cmap": "RdBu", "vmin": -top} if pulls else {"cmap": "Blues", "vmin": 0.0}
    mesh = ax.pcolormesh(y, z, p.T, vmax=top, shading="nearest", **colours)
    ax.figure.colorbar(mesh, ax=ax, label="pressure [kPa]", shrink=0.75)
    if touching is not None and np.any(touching) and not np.all(touching):
        _outline(ax, scene, np.asarray(touching))
    if len(tractions) > 1:
        drag = 1e-3 * np.hypot(tractions[1], tractions[2])
        longest = float(np.nanmax(drag, initial=0.0))
        seen = drag > 0.1 * longest
        if longest > 0.0:
            step = 1e3 * min(scene.spacing, scene.spacing_z)
            at_y, at_z = np.meshgrid(y, z, indexing="ij")
            arrows = (1e-3 * np.asarray(part)[seen] for part in tractions[1:])
            quiver = ax.quiver(
                at_y[seen], at_z[seen], *arrows, angles="xy", scale_units="xy", scale=longest / (2.0 * step), width=0.006
            )
            ax.quiverkey(quiver, 0.9, 0.06, longest, f"drag {longest:.3g} kPa", labelpos="W")
    return _seen_from_outside(ax)


def _outline(ax: Any, scene: Skin, touching: Any) -> None:
    """Around cells that touch, along their edges."""
    inside = np.pad(touching, 1)
    y = 1e3 * (scene.y[0] + scene.spacing * (np.arange(len(scene.y) + 1) - 0.5))
    z = 1e3 * (scene.z[0] + scene.spacing_z * (np.arange(len(scene.z) + 1) - 0.5))
    lines = []
    for i, j in np.argwhere(inside[1:, 1:-1] != inside[:-1, 1:-1]):
        lines.append([(y[i], z[j]), (y[i], z[j + 1])])
    for i, j in np.argwhere(inside[1:-1, 1:] != inside[1:-1, :-1]):
        lines.append([(y[i], z[j]), (y[i + 1], z[j])])
    collections = optional("matplotlib.collections", "plot")
    ax.add_collection(collections.LineCollection(lines, colors="0.25", linewidths=1))


def _reading_map(scene: Skin, frame: Any, ax: Any) -> Any:
    ax = _square(ax)
    values = np.asarray(scene._rows(frame)[0][0])
    first = scene.sites.channel == 0
    top = float(np.nanmax(np.abs(values[first]), initial=0.0)) or 1.0
    dots = ax.scatter(
        1e3 * scene.sites.y[first], 1e3 * scene.sites.z[first], c=values[first], cmap="RdBu", vmin=-top, vmax=top, s=60
    )
    ax.figure.colorbar(dots, ax=ax, label=scene.channels[0])
    return _seen_from_outside(ax)


def _square(ax: Any) -> Any:
    if ax is not None:
        return ax
    return optional("matplotlib.pyplot", "plot").subplots(figsize=(5.5, 4.5), layout="constrained")[1]


def _seen_from_outside(ax: Any) -> Any:
    ax.set_aspect("equal")
    if not ax.yaxis_inverted():
        ax.invert_yaxis()
    ax.set_xlabel("y [mm]")
    ax.set_ylabel("z [mm]")
    return ax


def _forces(solution: SkinSolution, ax: Any) -> Any:
    t = np.arange(len(solution)) if solution.t is None else solution.t
    values, deviation = solution.wrench[:, :3], 2 * solution.wrench_deviation[:, :3]
    low, high = values - deviation, values + deviation
    if solution.scene.to_dict().get("reconstruct", {}).get("answer") == "mixture":
        force, drag = solution.interval("normal_force"), solution.interval("tangential_force")
        low, high = np.moveaxis(np.concatenate([force[:, None], drag], axis=1), -1, 0)
    for i, name in enumerate(("into the skin", "along y", "along z")):
        (line,) = ax.plot(t, values[:, i], label=name)
        ax.fill_between(t, low[:, i], high[:, i], color=line.get_color(), alpha=0.2, linewidth=0)
    ax.axhline(0.0, color="0.8", linewidth=1)
    ax.set_xlabel("frame" if solution.t is None else "t [s]")
    ax.set_ylabel("force [N]")
    ax.legend(frameon=False)
    return ax


def _answers(ax: Any, y: Any, name: str, values: Any, deviation: Any) -> None:
    for i, component in enumerate(("normal", "tangential")[: len(values)]):
        (line,) = ax.plot(y, 1e-3 * values[i], label=f"{name}, {component}")
        if deviation is not None:
            low, high = values[i] - 2 * deviation[i], values[i] + 2 * deviation[i]
            ax.fill_between(y, 1e-3 * low, 1e-3 * high, color=line.get_color(), alpha=0.2, linewidth=0)

"""What was found as a force at each taxel: LeRobot's point sets, and Isaac's arrays of newtons."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .._arrays import Floats
from .._optional import optional

if TYPE_CHECKING:
    from .._skin_solution import SkinSolution
    from ._pad import SensorRecording

__all__ = ["PointSet", "point_set"]

_FORCES = ("Fx", "Fy", "Fz")
_LAYOUTS = {"lerobot": ("dx", "dy", "dz", *_FORCES), "isaac": _FORCES}


class PointSet(NamedTuple):
    """Numbers at each taxel, along the axes of the sensor. Made by `SkinSolution.to_point_set`."""

    values: Floats
    """(T, N, C) [m, N]: forces on the sensor, and displacements where it reads them, else nan."""
    sigma: Floats
    """(T, N, C): one standard deviation of each is at most this; nan where it is not known."""
    columns: tuple[str, ...]
    """Of the last axis."""
    t: Floats | None = None
    """(T,): of each frame [s]; None: not known."""

    def save(self, path: str | PathLike[str], *, name: str = "observation.tactile") -> None:
        """Parquet, a frame a row: the columns `name` and `name`.sigma hold lists of N lists of C, `timestamp` seconds;
        `tn.load(path, sensor="lerobot", units={"displacement": "m", "force": "N"}, ...)` reads it. Needs pyarrow.
        """
        from .._files import whole

        arrow = optional("pyarrow", "tables")
        parquet = optional("pyarrow.parquet", "tables")
        columns: dict[str, Any] = {"frame_index": np.arange(len(self.values))}
        if self.t is not None:
            columns["timestamp"] = self.t
        for key, values in ((name, self.values), (f"{name}.sigma", self.sigma)):
            columns[key] = arrow.array(values.tolist(), type=arrow.list_(arrow.list_(arrow.float64())))
        names = " ".join(self.columns).encode()
        fields = [
            arrow.field(key, column.type, metadata={b"names": names} if key == name else None)
            for key, column in ((key, arrow.array(column)) for key, column in columns.items())
        ]
        with whole(fspath(path)) as to:
            parquet.write_table(
                arrow.table(list(columns.values()), schema=arrow.schema(fields)), to, compression="zstd"
            )


def point_set(solution: SkinSolution, sensor: SensorRecording, layout: str) -> PointSet:
    """Each taxel's force is that of the cells nearest to it: of those that a contact covers, or all where none is certain to.

    What the resultant has beside their sum, where it is corrected or a mean of many answers, is shared as they share it: all
    sum up to the resultant.
    """
    if layout not in _LAYOUTS:
        raise ValueError(f"there is no layout {layout!r} of point sets: {', '.join(_LAYOUTS)}")
    middles, vectors = _cells(solution, sensor)
    frames, components = solution.tractions.shape[:2]
    pressed = solution.tractions.reshape(frames, components, -1)
    touching = solution.touching.reshape(frames, -1)
    counted = np.where(touching.any(axis=1, keepdims=True), touching, True)[:, np.newaxis]
    deviation = np.where(counted, solution.deviation.reshape(pressed.shape), 0.0)
    surface = _surface(sensor)
    nearest = np.array([int(np.argmin(((surface - middle) ** 2).sum(axis=1))) for middle in middles])
    share = np.zeros((len(surface), len(middles)))
    share[nearest, np.arange(len(middles))] = 1.0
    forces = np.einsum(
        "nc,tuc,cux->tnx", share, np.where(counted, pressed, 0.0), vectors[:, :components], optimize=True
    )
    forces += _shared(forces) * (_resultant(solution, sensor) - forces.sum(axis=1))[:, np.newaxis]
    # Cells beside one another err together or against one another: together is the most that they can.
    sigma = np.einsum("nc,tuc,cux->tnx", share, deviation, np.abs(vectors[:, :components]), optimize=True)
    values, doubt = [forces], [sigma]
    if layout == "lerobot":
        moved = _displacements(sensor)
        values.insert(0, moved)
        noise = sensor.pad.noise if sensor.pad.noise is not None else sensor.frames.noise
        doubt.insert(0, np.where(np.isnan(moved), np.nan, np.nan if noise is None else noise))
    return PointSet(np.concatenate(values, axis=2), np.concatenate(doubt, axis=2), _LAYOUTS[layout], solution.t)


def _shared(forces: Floats) -> Floats:
    """(T, N, 1): each taxel's share of a frame; all alike where there is no force."""
    size = np.linalg.norm(forces, axis=2, keepdims=True)
    whole = size.sum(axis=1, keepdims=True)
    return np.asarray(np.where(whole > 0.0, size / np.where(whole > 0.0, whole, 1.0), 1.0 / forces.shape[1]))


def _resultant(solution: SkinSolution, sensor: SensorRecording) -> Floats:
    """(T, 3): the force on the sensor along its axes; of drags that were not solved for, none."""
    if solution.surface is not None:
        return solution.force
    components = solution.tractions.shape[1]
    return np.asarray(solution.wrench[:, :components] @ sensor.flat_frame[:components])


def _surface(sensor: SensorRecording) -> Floats:
    """(N, 3): the places of the surface above the taxels."""
    return np.asarray(sensor.geometry.positions + sensor._depth[0][:, np.newaxis] * sensor.geometry.normals)


def _cells(solution: SkinSolution, sensor: SensorRecording) -> tuple[Floats, Floats]:
    """(cells, 3) middles, and (cells, 3, 3): what a traction of 1 along x, e_y and e_z of a cell presses with, [m^2] along the
    sensor's axes."""
    if solution.surface is not None:
        return solution.surface.middles, solution.surface.forces
    frame = sensor.flat_frame
    above = _surface(sensor)
    height = float((above @ frame[0]).mean())
    y, z = np.meshgrid(solution.y, solution.z, indexing="ij")
    middles = np.stack([np.full(y.size, height), y.ravel(), z.ravel()], axis=1) @ frame
    return middles, np.broadcast_to(solution.scene.cell_area * frame, (len(middles), 3, 3))


def _displacements(sensor: SensorRecording) -> Floats:
    """(T, N, 3) along the sensor's axes; nan where it reads none."""
    readings = sensor.frames.readings
    if sensor.frames.units != "m" or readings.shape[2] != 3:
        return np.full((*readings.shape[:2], 3), np.nan)
    if sensor.frames.frame == "sensor":
        return readings
    return np.asarray(np.einsum("nij,tni->tnj", sensor.local_frames, readings))

"""MuJoCo's sensor `tactile`: of each vertex of a mesh how deep an object reaches [m], and its slip along two tangents [m/s].

.npz with `sensordata` (frames, sensors' numbers), as mujoco.MjData has them, and `time`; the model's MJCF by `model=`, and the
sensor's name by `name=` where it has several."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _core
from .._geometry import Frames, Geometry
from .._optional import optional
from .._refusal import refused
from . import Given
from ._reading import arrays_in, one_of, start_of, times_in

name = "mujoco"
refusal = _core.sensor_refusal(name)


def sniff(path: str) -> float:
    """A .npz with sensordata."""
    return 0.7 if start_of(path, 2) == b"PK" and b"sensordata.npy" in start_of(path, 1 << 16) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """The vertices of the sensor's mesh, in the frame of its geom, with the mesh's normals."""
    model, sensor = _sensor(path, given)
    mesh = int(model.sensor_objid[sensor])
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    vertices = np.array(model.mesh_vert[first : first + count], dtype=float)
    start, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    corners = model.mesh_face[start : start + faces]
    sides = np.cross(
        vertices[corners[:, 1]] - vertices[corners[:, 0]], vertices[corners[:, 2]] - vertices[corners[:, 0]]
    )
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, corners[:, k], sides)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    if (length == 0.0).any():
        raise refused(path, "has a mesh with vertices of no face", "leave them out of the mesh")
    return Geometry(vertices, normals / length, reads=("depth", "slip_1", "slip_2"), file=path)


def frames(path: str, given: Given) -> Frames:
    """Depth [m] and slip along the mesh's tangents [m/s], in the order of the vertices; units tells that of the first."""
    arrays = arrays_in(path)
    if "sensordata" not in arrays or arrays["sensordata"].ndim != 2:
        raise refused(path, "has no sensordata of (frames, numbers)", "numpy.savez(path, sensordata=..., time=...)")
    data = arrays["sensordata"]
    model, sensor = _sensor(path, given)
    start, size = int(model.sensor_adr[sensor]), int(model.sensor_dim[sensor])
    if data.shape[1] != model.nsensordata:
        raise refused(
            path, f"has {data.shape[1]} numbers a frame, and the model has {model.nsensordata}", "model= its MJCF"
        )
    values = data[:, start : start + size].reshape(len(data), 3, -1).transpose(0, 2, 1)
    return Frames(
        values,
        times_in(arrays, len(data)),
        "m",
        "local",
        notes=("channel 0 is a depth [m], 1 and 2 slip [m/s]",),
        file=path,
    )


def _sensor(path: str, given: Given) -> tuple[Any, int]:
    """The model, and which of its sensors."""
    library = optional("mujoco", "mujoco")
    if given.model is None:
        raise refused(path, "says not of which model it is", "model= its MJCF")
    try:
        model = library.MjModel.from_xml_path(given.model)
    except ValueError as error:
        raise refused(given.model, f"is no model: {error}") from None
    kind = int(library.mjtSensor.mjSENS_TACTILE)
    found = {model.sensor(k).name or f"{k}": k for k in range(model.nsensor) if int(model.sensor_type[k]) == kind}
    return model, found[one_of(given.model, found, given.name, "sensor tactile")]

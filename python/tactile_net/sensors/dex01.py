"""Analog Devices DEX-01: 738 normal forces [N], as its simulator gives them. .npz with `normal_forces` (frames, taxels), or with
`frames` (frames, 32, 32) by the pattern's taxel2pixel; the pattern of taxels (poses, taxel2pixel) is a .npz of the simulator."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .._arrays import Floats
from .._geometry import Frames, Geometry
from .._refusal import refused
from . import Given
from ._reading import arrays_in, start_of, times_in

name = "dex01"
refusal = ""


def sniff(path: str) -> float:
    """A .npz with normal_forces."""
    start = start_of(path, 1 << 16)
    return 0.8 if start.startswith(b"PK") and b"normal_forces.npy" in start else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """Places and outward normals of the pattern that model= names."""
    poses, _ = _pattern(path, given)
    return Geometry(poses[:, :, 3], poses[:, :, 2], reads=("force_x",), file=given.model or path)


def frames(path: str, given: Given) -> Frames:
    """Forces into the pad [N]."""
    arrays = arrays_in(path)
    forces = arrays.get("normal_forces")
    if forces is None and "frames" in arrays:
        forces = _from_pixels(path, arrays["frames"], _pattern(path, given)[1])
    if forces is None or forces.ndim != 2:
        shapes = {name: array.shape for name, array in arrays.items()}
        raise refused(
            path, f"has {shapes}, not normal_forces (frames, taxels)", "numpy.savez(path, normal_forces=..., t=...)"
        )
    if (forces < 0.0).any():
        raise refused(path, "has normal forces below 0", "save sensor.data.normal_forces, which only press")
    return Frames(forces[..., np.newaxis].astype(float), times_in(arrays, len(forces)), "N", "local", file=path)


def _pattern(path: str, given: Given) -> tuple[Floats, NDArray[np.int64]]:
    """(N, 3, 4): axes of each taxel, the third its outward normal, and its place [m]; (N, 2): its pixel."""
    if given.model is None:
        raise refused(
            path, "has no places of its taxels", "model= the pattern that comes with the simulator, dex01_pattern.npz"
        )
    arrays = arrays_in(given.model)
    poses, pixels = arrays.get("poses"), arrays.get("taxel2pixel")
    if (
        poses is None
        or pixels is None
        or poses.shape[1:] != (3, 4)
        or pixels.shape != (len(poses), 2)
        or pixels.dtype.kind not in "iu"
    ):
        raise refused(
            given.model,
            "has no poses (taxels, 3, 4) with taxel2pixel (taxels, 2)",
            "dex01_pattern.npz of the simulator",
        )
    axes = poses[:, :, :3]
    if not np.isfinite(poses).all() or not np.allclose(axes.transpose(0, 2, 1) @ axes, np.eye(3), atol=1e-5):
        raise refused(given.model, "has axes of taxels that are not at right angles")
    normals = axes[:, :, 2] / np.linalg.norm(axes[:, :, 2], axis=1, keepdims=True)
    return np.concatenate([axes[:, :, :2], normals[:, :, np.newaxis], poses[:, :, 3:]], axis=2).astype(
        float
    ), pixels.astype(np.int64)


def _from_pixels(path: str, images: NDArray[np.float64], pixels: NDArray[np.int64]) -> NDArray[np.float64]:
    if images.ndim != 3 or (pixels < 0).any() or (pixels >= images.shape[1:]).any():
        raise refused(path, f"has frames of the shape {images.shape}, and pixels up to {pixels.max(axis=0).tolist()}")
    forces: NDArray[np.float64] = images[:, pixels[:, 0], pixels[:, 1]]
    lost = np.abs(images).sum() - np.abs(forces).sum()
    if lost > 1e-6 * np.abs(images).sum():
        raise refused(path, "has forces at pixels of no taxel", "model= the pattern that these frames were made with")
    return forces

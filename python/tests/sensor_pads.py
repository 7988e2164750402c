"""Pads and flat sensors that the tests of sensors' files share."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import tactile_net as tn

PAD: dict[str, Any] = {"thickness": 3e-3, "poisson_ratio": 0.48}
SOFT: dict[str, Any] = PAD | {"youngs_modulus": 50e3}


def flat_grid(rows: int, columns: int, pitch: float = 2e-3) -> tn.Geometry:
    places = np.stack(np.meshgrid(np.arange(rows) * pitch, np.arange(columns) * pitch, [0.0], indexing="ij"), -1)
    return tn.Geometry(places.reshape(-1, 3), np.broadcast_to([0.0, 0.0, 1.0], (rows * columns, 3)))


def bump(geometry: tn.Geometry, peak: float) -> NDArray[np.float64]:
    """(N,): of a press in the middle."""
    away = geometry.positions - geometry.positions.mean(axis=0)
    return peak * np.exp(-np.sum(away**2, axis=1) / (2 * 3e-3**2))


def lattice_skin(
    rows: int, columns: int, pitch: float, force: float = 1.0, reads: tuple[str, ...] = ("stress_x",)
) -> tn.Skin:
    """Of stresses on the core of PAD, with a ball that presses its middle."""
    return tn.Skin(
        sensor=tn.Sensor(rows=rows, columns=columns, pitch=pitch, depth=3e-3, reads=list(reads)),
        material=tn.Material(youngs_modulus=50e3, poisson_ratio=0.48, layer=tn.Layer(thickness=3e-3, base="bonded")),
        contacts=[tn.Sphere(force=force, radius=2.5e-3)],
        units={},
    )



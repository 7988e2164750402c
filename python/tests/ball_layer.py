"""Stress on the core under a layer bonded to a ball, by the series of spherical harmonics in NumPy: nothing of the library."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def stress_shares(radius: float, thickness: float, poisson_ratio: float) -> Floats:
    """Of each degree n of a pressure on the surface, the share that presses on the core.

    Displacements are grad(r^m Y) and D r^2 grad(r^m Y) + N r r^m Y with m = n and -n - 1 (Love 1927, 172), in units of the
    radius and of the shear modulus.
    """
    nu, core = poisson_ratio, 1.0 - thickness / radius

    def rows(n: int, r: float) -> Floats:
        """Radial and tangential displacement, radial and tangential stress of the four."""
        columns = []
        for m in (n, -n - 1):
            q = r**m if m > 0 else (core / r) ** (n + 1)
            d, e = m + 5 - 4 * nu, -2 * (2 * nu * m + (3 * m + 1) * (1 - 2 * nu))
            columns.append([m * q / r, q / r, 2 * m * (m - 1) * q / r**2, 2 * (m - 1) * q / r**2])
            radial, along, dilated = (d * m + e) * q * r, d * q * r, 2 * nu * (2 * m + 3) * (2 * m + 2) * q
            columns.append([radial, along, 2 * (m + 1) * radial / r - dilated, (m * along + radial) / r])
        return np.array(columns).T

    volume = 2 * nu / (1 - 2 * nu)
    swell = np.array([[core, core**-2], [2 + 3 * volume, -4.0]])
    a, b = np.linalg.solve(swell, [0.0, 1.0])
    shares = [a * (2 + 3 * volume) - 4 * b * core**-3]
    for n in range(1, int(26 * radius / thickness)):
        there, here = rows(n, core), rows(n, 1.0)
        system = np.vstack([there[:2], here[2:]])
        size = np.abs(system).max(axis=0)
        shares.append(there[2] @ (np.linalg.solve(system / size, [0.0, 0.0, 1.0, 0.0]) / size))
    return np.array(shares)


def stress_under(force: float, radius: float, thickness: float, poisson_ratio: float, arcs: Floats) -> Floats:
    """Under a force at a point along the normal, at these angles about the ball's centre [rad]."""
    shares = stress_shares(radius, thickness, poisson_ratio)
    degrees = 2 * np.arange(len(shares)) + 1
    return np.asarray(np.polynomial.legendre.legval(np.cos(arcs), force * degrees / (4 * np.pi * radius**2) * shares))


def press_on(points: Floats, normals: Floats, at: int, force: float, thickness: float, poisson_ratio: float, disc: float) -> tuple[Floats, Floats]:
    """Stress on the core at each of its points [Pa], and the force on the pad along the sensor's axes [N], of a press above one
    of the points, with the pressure of a ball: as on the ball through the point's neighbours."""
    near = np.argsort(np.linalg.norm(points - points[at], axis=1))[:9]
    moved, turned = points[near] - points[at], normals[near] - normals[at]
    curvature = (moved * turned).sum() / (moved**2).sum()
    core = 1.0 / max(curvature, 2.0)
    centre = points[at] - core * normals[at]
    e_y = np.linalg.svd(normals[at : at + 1])[2][1]
    e_z = np.cross(normals[at], e_y)
    count = 120
    away = np.sqrt((np.arange(count) + 0.5) / count)
    around = np.pi * (1 + np.sqrt(5)) * np.arange(count)
    angle = away * disc / (core + thickness)
    sideways = np.cos(around)[:, None] * e_y + np.sin(around)[:, None] * e_z
    outward = np.cos(angle)[:, None] * normals[at] + np.sin(angle)[:, None] * sideways
    share = np.sqrt(1 - away**2) / np.sqrt(1 - away**2).sum()
    chord = np.linalg.norm(points[:, None] - (centre + core * outward), axis=2)
    arcs = 2 * np.arcsin(np.minimum(chord / (2 * core), 1.0))
    stress = stress_under(force, core + thickness, thickness, poisson_ratio, arcs) @ share
    return stress, -force * share @ outward

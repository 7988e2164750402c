"""Normals and areas of a smooth surface that is known at points alone."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ._arrays import Floats
from ._refusal import refused

NEIGHBOURS = 12


def neighbours_of(positions: Floats, count: int) -> tuple[np.ndarray, Floats]:
    """(N, count): the nearest other points, the nearest first; and how far away."""
    count = min(count, len(positions) - 1)
    squares = np.einsum("ij,ij->i", positions, positions)
    nearest = np.empty((len(positions), count), dtype=np.intp)
    for start in range(0, len(positions), 512):
        rows = slice(start, start + 512)
        apart = squares[rows, np.newaxis] + squares - 2.0 * positions[rows] @ positions.T
        apart[np.arange(apart.shape[0]), np.arange(start, start + apart.shape[0])] = np.inf
        nearest[rows] = np.argsort(apart, axis=1, kind="stable")[:, :count]
    distance = np.linalg.norm(positions[nearest] - positions[:, np.newaxis], axis=2)
    return nearest, distance


def fitted_normals(where: str, positions: Floats, outward: Sequence[float] | None) -> tuple[Floats, str]:
    """(N, 3) of unit length, all to one side, and a note of how they were found.

    Raises InputError where the points lie on a line, or fall apart so that their sides cannot be compared.
    """
    centred = positions - positions.mean(axis=0)
    spread = np.linalg.svd(centred, compute_uv=False)
    if spread[1] <= 1e-6 * spread[0]:
        raise refused(where, "has all its taxels on a line", "a surface cannot be fitted to them: give normals")
    centred = centred / spread[0]
    nearest, _ = neighbours_of(centred, NEIGHBOURS)
    normals = np.empty_like(positions)
    missed = np.empty(len(positions))
    for k, around in enumerate(nearest):
        normals[k], missed[k] = _quadric(centred[around] - centred[k])
    normals *= _one_side(normals, nearest)[:, np.newaxis]
    if outward is not None:
        towards = float(normals.mean(axis=0) @ np.asarray(outward, dtype=float))
        side = "to the side that outward= names"
    else:
        # Out of a convex surface points lead away from their middle. A surface that hardly bends has no such side.
        towards = float(np.einsum("ij,ij->", normals, centred)) / len(normals)
        side = "to the side to which the surface bulges"
        if abs(towards) < 1e-3 * float(np.linalg.norm(centred, axis=1).max()):
            towards = float(normals.mean(axis=0) @ _AXIS[np.argmax(np.abs(normals.mean(axis=0)))])
            side = "along the positive axis of the sensor that they are nearest to, as the surface is nearly flat"
    if towards == 0.0:
        raise refused(where, "has a surface of which no side is the outer one", "give normals, or outward=")
    if towards < 0.0:
        normals = -normals
    scale = 1e3 * spread[0]
    note = (
        f"normals are fitted: quadrics through {nearest.shape[1]} neighbours, which miss them by "
        f"{scale * np.sqrt(np.mean(missed**2)):.2g} mm (rms; at most {scale * missed.max():.2g} mm), turned {side}"
    )
    return normals, note


_AXIS = np.eye(3)


def _quadric(around: Floats) -> tuple[Floats, float]:
    """Normal at 0 of the quadric nearest to 0 and these points, and the rms by which it misses them."""
    points = np.vstack([np.zeros(3), around])
    axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2] if len(points) > 2 else np.eye(3)
    if len(axes) < 3:
        axes = np.vstack([axes, np.cross(axes[0], axes[1])])
    distance = np.linalg.norm(points, axis=1)
    weight = np.exp(
        -0.5 * (distance / np.median(distance[1:])) ** 2
    )  # those around an edge tell little of the taxel's side
    for _ in range(3):  # again in the frame of the normal that was found
        s, t, height = (points @ axes.T).T
        terms = [np.ones_like(s), s, t] + ([s * s, s * t, t * t] if len(points) > 6 else [])
        table = np.stack(terms, axis=1)
        found = np.linalg.lstsq(weight[:, np.newaxis] * table, weight * height, rcond=None)[0]
        normal = axes[2] - found[1] * axes[0] - found[2] * axes[1]
        normal /= np.linalg.norm(normal)
        first = axes[0] - (axes[0] @ normal) * normal
        first /= np.linalg.norm(first)
        axes = np.stack([first, np.cross(normal, first), normal])
    return normal, float(np.sqrt(np.average((table @ found - height) ** 2, weights=weight)))


def _one_side(normals: Floats, nearest: np.ndarray) -> Floats:
    """Signs that turn all normals to the side of the first, from neighbour to neighbour, the most alike first."""
    import heapq

    count = len(normals)
    links: list[set[int]] = [set() for _ in range(count)]
    for k, around in enumerate(nearest.tolist()):
        for other in around[:6]:
            links[k].add(other)
            links[other].add(k)
    signs = np.zeros(count)
    for seed in range(count):  # parts that are not linked are each turned by themselves
        if signs[seed] != 0.0:
            continue
        alike = normals[signs != 0.0].mean(axis=0) @ normals[seed] if (signs != 0.0).any() else 1.0
        queue = [(0.0, seed, 1.0 if alike >= 0.0 else -1.0)]
        while queue:
            _, k, sign = heapq.heappop(queue)
            if signs[k] != 0.0:
                continue
            signs[k] = sign
            for other in links[k]:
                if signs[other] == 0.0:
                    dot = float(normals[k] @ normals[other])
                    heapq.heappush(queue, (1.0 - abs(dot), other, sign if dot >= 0.0 else -sign))
    return signs


def areas_of(positions: Floats, normals: Floats) -> Floats:
    """(N,): Voronoi cells in each taxel's tangent plane; where no neighbour is, one is thought opposite to one that is there."""
    nearest, distance = neighbours_of(positions, NEIGHBOURS)
    areas = np.empty(len(positions))
    for k, around in enumerate(nearest):
        away = positions[around] - positions[k]
        along = away - (away @ normals[k])[:, np.newaxis] * normals[k]
        length = np.linalg.norm(along, axis=1)
        along *= (distance[k] / np.where(length > 0.0, length, 1.0))[:, np.newaxis]
        first = along[0] / np.linalg.norm(along[0])
        flat = np.stack([along @ first, along @ np.cross(normals[k], first)], axis=1)
        direction = flat / np.linalg.norm(flat, axis=1)[:, np.newaxis]
        open_side = (direction @ -direction.T).max(axis=0) < 0.5  # nobody within 60 degrees of the opposite direction
        areas[k] = _cell(np.vstack([flat, -flat[open_side]]))
    return areas


def _cell(others: Floats) -> float:
    """Area of the points nearer to 0 than to any of these, and no further away than twice the nearest."""
    reach = 2.0 * float(np.linalg.norm(others, axis=1).min())
    corners = reach * np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    for other in others:
        inside = 0.5 * float(other @ other) - corners @ other
        kept = []
        for a in range(len(corners)):
            b = (a + 1) % len(corners)
            if inside[a] >= 0.0:
                kept.append(corners[a])
            if inside[a] * inside[b] < 0.0:
                kept.append(corners[a] + (corners[b] - corners[a]) * (inside[a] / (inside[a] - inside[b])))
        corners = np.array(kept)
    x, y = corners.T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))

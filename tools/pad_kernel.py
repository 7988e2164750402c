#!/usr/bin/env python3
"""The kernel K of a curved soft pad on a rigid core, by finite elements: what each taxel reads under a unit traction on each cell.

The pad is `thickness` thick everywhere, bonded to its core, free at its edges, linear and isotropic. Elements have 27 nodes: their
displacements are triquadratic, their pressure is linear and condensed, so that nothing locks up to a Poisson's ratio of 0.4999.
A reading is a sum r'u over nodal displacements, and A is symmetric: one solve A w = r gives the reading's row of K, since the work of
a cell's unit traction on w is what the taxel reads under it. docs/kernels.md has it step by step.

    tools/pad_kernel.py finger.csv --sphere --thickness 4e-3 --youngs-modulus 0.25e6 --poisson-ratio 0.48 --frame sensor -o k.npz
    tools/pad_kernel.py finger.csv --surface finger.obj --length-unit mm --thickness 3.5 ... --cells 18x18 --elements 24x24x4

It needs NumPy and SciPy; with pypardiso or scikit-sparse 0.4 large pads are several times as fast. Exit status 0: K is written; 1: it is not, and
why; 2: wrong use.
"""

from __future__ import annotations

import argparse
import csv
import dataclasses
import os
import resource
import sys
import time
from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, Protocol

try:
    import numpy as np
    from scipy import sparse
    from scipy.sparse import linalg
except ModuleNotFoundError as missing:
    if __name__ != "__main__":
        raise
    sys.exit(f"error: {missing.name} is not installed: pip install numpy scipy")

Array = np.ndarray[Any, np.dtype[Any]]

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 25.4e-3}
# Of the component: its two axes (a displacement has one), in the frame x into the pad, y, z along its surface.
QUANTITIES = {
    "stress_x": ("Pa", 0, 0), "stress_y": ("Pa", 1, 1), "stress_z": ("Pa", 2, 2),
    "shear_xy": ("Pa", 0, 1), "shear_xz": ("Pa", 0, 2), "shear_yz": ("Pa", 1, 2),
    "strain_x": ("1", 0, 0), "strain_y": ("1", 1, 1), "strain_z": ("1", 2, 2),
    "shear_strain_xy": ("1", 0, 1), "shear_strain_xz": ("1", 0, 2), "shear_strain_yz": ("1", 1, 2),
    "displacement_x": ("m", 0, 0), "displacement_y": ("m", 1, 1), "displacement_z": ("m", 2, 2),
}  # fmt: skip
COLUMNS = ("name", "x", "y", "z", "nx", "ny", "nz", "depth", "reads")
MOST_POISSON = 0.4999
MOST_UNKNOWNS = 1_000_000
STEEPEST = np.radians(75.0)  # between a ray of the lattice and the middle one


class Refusal(Exception):
    """Something that was given cannot be; the message says what, where, and what to give instead."""


# --- Taxels -----------------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Taxels:
    """Lengths in metres; `place` is where the taxel reads, `depth` its distance from the surface against the outward normal."""

    names: list[str]
    place: Array  # (n, 3)
    normal: Array  # (n, 3)
    depth: Array  # (n)
    reads: list[list[str]]

    @property
    def above(self) -> Array:
        """The places of the surface above the taxels."""
        return self.place + self.depth[:, None] * self.normal

    def readings(self) -> list[tuple[int, str]]:
        """Taxel and quantity of each reading: a channel for each quantity, in the order in which taxels first read it."""
        quantities = list(dict.fromkeys(quantity for reads in self.reads for quantity in reads))
        return [(i, quantity) for quantity in quantities for i, reads in enumerate(self.reads) if quantity in reads]


def quantities_in(text: str, where: str) -> list[str]:
    words = text.split()
    for i, word in enumerate(words):
        if word not in QUANTITIES:
            raise Refusal(f"{where} reads {word!r}: it may read {', '.join(QUANTITIES)}")
        if word in words[:i]:
            raise Refusal(f"{where} reads {word} twice: name it once")
    if not words:
        raise Refusal(f"{where} reads nothing: name at least one of {', '.join(QUANTITIES)}")
    return words


def read_taxels(path: Path, length: str, reads: str) -> Taxels:
    """The taxels of a CSV file with the columns name,x,y,z,nx,ny,nz,depth,reads; name and reads may be missing.

    Lengths are in the unit `length`; a header may repeat it, as "x [mm]".
    """
    rows = [
        (number, [field.strip() for field in row])
        for number, row in enumerate(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()), 1)
        if row and any(row) and not row[0].startswith("#")
    ]
    if not rows:
        raise Refusal(f"{path}: it is empty: its first line names the columns {','.join(COLUMNS)}")
    first, header = rows[0]
    names = []
    for title in header:
        name, _, unit = title.partition("[")
        names.append(name.strip())
        if unit and unit.rstrip("] ") != length and names[-1] != "name":
            raise Refusal(
                f"{path}:{first}: column {title!r} has another unit than {length}: give --length-unit {unit.rstrip('] ')}"
            )
        if names[-1] not in COLUMNS:
            raise Refusal(f"{path}:{first}: there is a column {title!r}: the columns are {','.join(COLUMNS)}")
        if names[-1] in names[:-1]:
            raise Refusal(f"{path}:{first}: there are two columns {names[-1]!r}: keep one")
    for name in COLUMNS[1:8]:
        if name not in names:
            what = "; a normal points out of the pad" if name in ("nx", "ny", "nz") else ""
            raise Refusal(f"{path}:{first}: there is no column {name}: the columns are {','.join(COLUMNS)}{what}")
    if len(rows) == 1:
        raise Refusal(f"{path}: it holds no taxel")
    taxels: list[str] = []
    numbers, quantities = [], []
    for number, row in rows[1:]:
        where = f"{path}:{number}"
        if len(row) != len(names):
            raise Refusal(f"{where}: it has {len(row)} fields, and the header {len(names)}")
        field = dict(zip(names, row, strict=True))
        taxels.append(field.get("name") or str(len(taxels)))
        if any(ord(letter) < 32 or letter in ',"\x7f' for letter in taxels[-1]):
            raise Refusal(f"{where}: a name must hold no comma, quotation mark or control character")
        if taxels[-1] in taxels[:-1]:
            raise Refusal(f"{where}: two taxels are called {taxels[-1]}: recordings call their columns by it")
        values = []
        for name in COLUMNS[1:8]:
            try:
                values.append(float(field[name]))
            except ValueError:
                values.append(np.nan)
            if not np.isfinite(values[-1]):
                raise Refusal(f"{where}: {name} is {field[name]!r}, which is no finite number")
        size = float(np.linalg.norm(values[3:6]))
        if abs(size - 1.0) > 1e-3:
            raise Refusal(f"{where}: the normal (nx, ny, nz) is {size:.4g} long: it must be of unit length, within 0.001")
        if values[6] <= 0.0:
            raise Refusal(f"{where}: depth is {values[6]:g}: it is the distance below the surface, above 0")
        numbers.append(values)
        quantities.append(quantities_in(field.get("reads") or reads, f"{where}: taxel {taxels[-1]}"))
    table = np.array(numbers)
    normal = table[:, 3:6] / np.linalg.norm(table[:, 3:6], axis=1)[:, None]
    result = Taxels(taxels, table[:, :3] * LENGTHS[length], normal, table[:, 6] * LENGTHS[length], quantities)
    seen: dict[tuple[Any, ...], int] = {}
    for i, quantity in result.readings():
        other = seen.setdefault((*(result.place[i] + 0.0).tolist(), quantity), i)
        if other != i:
            raise Refusal(
                f"{path}: taxels {taxels[other]} and {taxels[i]} are at one place and both read {quantity}: leave one out"
            )
    if len(taxels) > 1:
        extent = float(np.ptp(result.place, axis=0).max())
        if not 1e-3 <= extent <= 1.0:
            raise Refusal(
                f"{path}: the taxels extend over {extent:.3g} m, which is no fingertip and no hand: give --length-unit (it is {length} now)"
            )
    return result


def frames(normal: Array, reference: Array, whose: Callable[[int], str]) -> Array:
    """(n, 3, 3): rows x = -n, e_y = the reference made tangent, e_z = x cross e_y."""
    x = -normal
    along = x @ reference
    for i in np.flatnonzero(np.abs(along) > np.cos(np.radians(10.0))):
        raise Refusal(
            f"the reference direction {reference.tolist()} is within 10 degrees of the normal of {whose(int(i))}, so that it gives no "
            "tangent there: give another --reference; along a finger that is wrapped around, its axis"
        )
    y = reference - along[..., None] * x
    y /= np.linalg.norm(y, axis=-1)[..., None]
    return np.stack([x, y, np.cross(x, y)], axis=-2)


# --- Surfaces ---------------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Rays:
    """A pencil of rays across the surface, by which a rectangle of the plane (u, v) becomes a part of it.

    On a sphere these are equal angles about two axes, on a cylinder angle and length, on a plane two lengths. u and v are arcs [m] of
    the two circles through the middle that fit the surface along e_y and e_z.
    """

    middle: Array
    axes: Array  # rows e_y, e_z, outward
    curvature: Array  # along e_y and e_z, > 0 where convex [1/m]

    def ray(self, u: Array, v: Array) -> tuple[Array, Array]:
        """Points and directions, outward."""
        tangent = np.stack([np.tan(k * s) if k else 0.0 * s for k, s in zip(self.curvature, (u, v), strict=True)])
        start = np.stack([t / k if k else s for k, s, t in zip(self.curvature, (u, v), tangent, strict=True)])
        one = np.ones_like(u)
        points = self.middle + np.stack([*start, 0.0 * one], axis=-1) @ self.axes
        return points, np.stack([*tangent, one], axis=-1) @ self.axes

    def coordinates(self, points: Array) -> Array:
        """(n, 2): u and v of the rays through points; NaN behind the ray's end."""
        y, z, w = np.moveaxis((points - self.middle) @ self.axes.T, -1, 0)
        out = []
        for k, s in zip(self.curvature, (y, z), strict=True):
            with np.errstate(invalid="ignore"):
                out.append(np.where(1.0 + k * w > 0.0, np.arctan2(k * s, 1.0 + k * w) / k if k else s, np.nan))
        return np.stack(out, axis=-1)


class Surface(Protocol):
    rays: Rays

    def at(self, u: Array, v: Array) -> tuple[Array, Array]:
        """Points and outward unit normals of the surface where rays cross it."""


def middle_frame(taxels: Taxels, reference: Array) -> Array:
    """e_y, e_z and the outward normal in the middle of the taxels."""
    mean = taxels.normal.mean(axis=0)
    size = np.linalg.norm(mean)
    if size < 0.2:
        raise Refusal(
            "the taxels' normals point to all sides, so that no lattice of cells spans them: give the taxels of one side at a time"
        )
    x, y, z = frames((mean / size)[None], reference, lambda _: "the middle of the taxels")[0]
    return np.array([y, z, -x])


class Sphere:
    """R > 0: a ball, R < 0: a hole, whose outward normals point to its centre."""

    def __init__(self, centre: Array, radius: float, axes: Array) -> None:
        self.centre, self.radius = centre, radius
        self.rays = Rays(centre + radius * axes[2], axes, np.full(2, 1.0 / radius))

    def at(self, u: Array, v: Array) -> tuple[Array, Array]:
        _, normal = self.rays.ray(u, v)
        normal = normal / np.linalg.norm(normal, axis=-1)[..., None]
        return self.centre + self.radius * normal, normal

    @staticmethod
    def fitted(taxels: Taxels, thickness: float) -> tuple[Array, float]:
        """Centre and radius by least squares of centre + R n = the surface above each taxel."""
        above, normal = taxels.above, taxels.normal
        a = np.concatenate([np.broadcast_to(np.eye(3), (len(above), 3, 3)), normal[:, :, None]], axis=2).reshape(-1, 4)
        values, _, rank, _ = np.linalg.lstsq(a, above.ravel(), rcond=None)
        if rank < 4:
            raise Refusal(
                "the taxels' normals are parallel, so that they determine no sphere: give --sphere=X,Y,Z,R, or --surface"
            )
        residual = above.ravel() - a @ values
        spread = np.sqrt(residual @ residual / max(1, a.shape[0] - 4))
        deviation = spread * np.sqrt(np.linalg.inv(a.T @ a)[3, 3])
        if deviation > 0.2 * abs(values[3]):
            raise Refusal(
                f"the taxels do not determine the sphere: its radius is {values[3]:.3g} m, give or take {deviation:.2g}: "
                "give --sphere=X,Y,Z,R, or the outer surface as --surface"
            )
        worst = np.linalg.norm(residual.reshape(-1, 3), axis=1)
        if worst.max() > 0.1 * thickness:
            raise Refusal(
                f"the taxels lie on no sphere: the surface above {taxels.names[int(worst.argmax())]} is {worst.max():.2g} m off the one "
                f"that fits best (R = {values[3]:.3g} m): give the outer surface as --surface"
            )
        return values[:3], float(values[3])


class Mesh:
    """An outer surface of triangles, counterclockwise seen from outside, bent between its vertices as their normals say."""

    def __init__(self, path: Path, unit: float, taxels: Taxels, axes: Array) -> None:
        self.path = path
        self.vertices, self.triangles, self.lines = read_obj(path, unit)
        a, b, c = np.moveaxis(self.vertices[self.triangles], 1, 0)
        self.across = np.cross(b - a, c - a)
        for i in np.flatnonzero(np.linalg.norm(self.across, axis=1) == 0.0):
            raise Refusal(f"{self.of(i)} has no area: leave it out")
        self.check_edges()
        extent = float(np.ptp(self.vertices, axis=0).max())
        if not 1e-3 <= extent <= 1.0:
            raise Refusal(f"{path}: the mesh extends over {extent:.3g} m, which is no fingertip and no hand: give --length-unit")
        self.normals = self.vertex_normals()
        above = taxels.above
        middle = above.mean(axis=0)
        y, z, _ = np.moveaxis((above - middle) @ axes.T, -1, 0)
        slopes = taxels.normal @ axes.T
        curvature = np.zeros(2)
        for k, s in enumerate((y, z)):
            sine, cosine = slopes[:, [k, 2]].T / np.hypot(slopes[:, k], slopes[:, 2])
            fitted = float(s @ sine / (s @ s)) if s @ s > 1e-6 * extent**2 else 0.0
            if abs(fitted) * extent > 2e-3:  # below a tenth of a degree over all of the mesh it is flat
                curvature[k] = fitted
                middle = middle + np.mean(1.0 - cosine) / fitted * axes[2]  # taxels beside lie below the middle one
        self.rays = Rays(middle, axes, curvature)
        plane = self.rays.coordinates(self.vertices)
        plane[np.abs(plane * self.rays.curvature).max(axis=1) > np.radians(85.0)] = np.nan
        corners = plane[self.triangles]
        seen = np.isfinite(corners).all(axis=(1, 2))
        self.candidates = np.flatnonzero(seen)
        self.low, self.high = corners[seen].min(axis=1), corners[seen].max(axis=1)

    def of(self, triangle: int) -> str:
        return f"{self.path}:{self.lines[triangle]}: triangle {triangle + 1}"

    def check_edges(self) -> None:
        """Each edge has one triangle, or two that pass it in opposite directions."""
        ends = self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
        key = ends.min(axis=1) * len(self.vertices) + ends.max(axis=1)
        order = np.argsort(key, kind="stable")
        _, start, count = np.unique(key[order], return_index=True, return_counts=True)
        for i in np.flatnonzero(count > 2):
            raise Refusal(
                f"{self.of(order[start[i] + 2] // 3)} has an edge that two other triangles share: the mesh is no surface there; "
                "give the outer surface alone"
            )
        both = start[count == 2]
        first, second = order[both], order[both + 1]
        for i in np.flatnonzero(ends[first, 0] == ends[second, 0]):
            raise Refusal(
                f"{self.of(second[i] // 3)} is turned inside out against triangle {first[i] // 3 + 1} beside it: "
                "let all be counterclockwise seen from outside"
            )

    def vertex_normals(self) -> Array:
        """Means over the triangles at each vertex, by their angles there."""
        face = self.across / np.linalg.norm(self.across, axis=1)[:, None]
        normals = np.zeros_like(self.vertices)
        for k in range(3):
            at, left, right = (self.vertices[self.triangles[:, (k + j) % 3]] for j in range(3))
            p, q = left - at, right - at
            angle = np.arctan2(np.linalg.norm(np.cross(p, q), axis=1), np.einsum("ij,ij->i", p, q))
            np.add.at(normals, self.triangles[:, k], angle[:, None] * face)
        size = np.linalg.norm(normals, axis=1)
        used = np.unique(self.triangles)
        for i in used[size[used] == 0.0]:
            raise Refusal(f"{self.path}: the triangles at vertex {i + 1} lie on one another: give the outer surface alone")
        size[size == 0.0] = 1.0
        return normals / size[:, None]

    def at(self, u: Array, v: Array) -> tuple[Array, Array]:
        shape = np.shape(u)
        uv = np.stack([np.ravel(u), np.ravel(v)], axis=-1)
        start, direction = self.rays.ray(uv[:, 0], uv[:, 1])
        points, normals = np.empty_like(start), np.empty_like(start)
        slack = 1e-9 * float(np.ptp(self.vertices, axis=0).max())
        step = max(1, 20_000_000 // max(1, len(self.candidates)))
        for first in range(0, len(uv), step):
            some = slice(first, first + step)
            inside = ((uv[some, None] >= self.low - slack) & (uv[some, None] <= self.high + slack)).all(axis=2)
            ray, near = np.nonzero(inside)
            self.cross(start[some], direction[some], ray, self.candidates[near], points[some], normals[some])
        return points.reshape(*shape, 3), normals.reshape(*shape, 3)

    def cross(self, start: Array, direction: Array, ray: Array, triangle: Array, points: Array, normals: Array) -> None:
        """Puts in the point and the normal of each ray, of the pairs of rays and triangles that may meet."""
        a, b, c = np.moveaxis(self.vertices[self.triangles[triangle]], 1, 0)
        matrix = np.stack([b - a, c - a, -direction[ray]], axis=-1)
        steep = np.linalg.det(matrix)
        whole = np.abs(steep) > 1e-12 * np.linalg.norm(matrix, axis=1).prod(axis=1)
        ray, triangle, a, matrix = (part[whole] for part in (ray, triangle, a, matrix))
        second, third, height = np.linalg.solve(matrix, (start[ray] - a)[..., None])[..., 0].T
        weights = np.stack([1.0 - second - third, second, third], axis=-1)
        meets = weights.min(axis=1) > -1e-7
        ray, triangle, weights, height = (part[meets] for part in (ray, triangle, weights, height))
        outward = np.einsum("ij,ij->i", self.across[triangle], direction[ray]) > 0.0
        begin = np.searchsorted(ray, np.arange(len(start) + 1))
        for i in range(len(start)):
            mine = np.arange(begin[i], begin[i + 1])
            faces = mine[outward[mine]]
            where = ", ".join(f"{value:.4g}" for value in start[i])
            if not len(mine):
                raise Refusal(
                    f"{self.path}: the mesh is open at ({where}) m, where the pad or a taxel is: let it reach as far as --edge says beyond "
                    "the outermost taxels, without holes, or make --edge less"
                )
            if not len(faces):
                raise Refusal(
                    f"{self.of(triangle[mine[0]])} faces inward: the mesh is turned inside out; let it be counterclockwise seen from outside"
                )
            best = faces[np.argmax(height[faces])]
            for other in faces:
                if not np.intersect1d(self.triangles[triangle[best]], self.triangles[triangle[other]]).size:
                    raise Refusal(
                        f"{self.of(triangle[best])} lies above triangle {triangle[other] + 1}: the mesh lies over itself at ({where}) m; "
                        "give the outer surface alone"
                    )
            corner = self.triangles[triangle[best]]
            share = np.clip(weights[best], 0.0, None)
            share /= share.sum()
            flat = share @ self.vertices[corner]
            bent = np.einsum("ij,ij->i", flat - self.vertices[corner], self.normals[corner])
            points[i] = flat - 0.5 * (share * bent) @ self.normals[corner]
            normal = share @ self.normals[corner]
            normals[i] = normal / np.linalg.norm(normal)


def read_obj(path: Path, unit: float) -> tuple[Array, Array, list[int]]:
    """Vertices [m], triangles (polygons are cut into them) and the lines they stand in, of a Wavefront OBJ file."""
    vertices: list[list[float]] = []
    triangles, lines = [], []
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        words = line.split()
        try:
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
                if len(vertices[-1]) != 3 or not np.isfinite(vertices[-1]).all():
                    raise ValueError
            elif words[:1] == ["f"]:
                corners = [int(word.partition("/")[0]) for word in words[1:]]
                corners = [corner - 1 if corner > 0 else len(vertices) + corner for corner in corners]
                if (
                    len(corners) < 3
                    or len(set(corners)) != len(corners)
                    or min(corners) < 0
                    or "0" in {word.partition("/")[0] for word in words[1:]}
                ):
                    raise ValueError
                for k in range(1, len(corners) - 1):
                    triangles.append([corners[0], corners[k], corners[k + 1]])
                    lines.append(number)
        except ValueError:
            raise Refusal(
                f"{path}:{number}: {line[:60]!r} is no vertex of three finite numbers and no face of three or more vertices"
            ) from None
    if not triangles:
        raise Refusal(f"{path}: it holds no face: --surface takes a Wavefront OBJ file with lines v and f")
    faces = np.array(triangles)
    for i in np.flatnonzero(faces.max(axis=1) >= len(vertices)):
        raise Refusal(f"{path}:{lines[i]}: the face names vertex {faces[i].max() + 1} of {len(vertices)}")
    return np.array(vertices) * unit, faces, lines


# --- Elements ---------------------------------------------------------------------------------------------------------


def quadratics(s: Array) -> tuple[Array, Array]:
    """The three quadratic shape functions at places of [-1, 1] and their slopes: (n, 3) each."""
    return (
        np.stack([s * (s - 1.0) / 2.0, 1.0 - s * s, s * (s + 1.0) / 2.0], axis=-1),
        np.stack([s - 0.5, -2.0 * s, s + 0.5], axis=-1),
    )


def shapes(places: Array) -> tuple[Array, Array]:
    """Of 27 nodes at places (n, 3) of the cube: values (n, 27) and slopes (n, 27, 3); the last direction's node runs fastest."""
    (a, da), (b, db), (c, dc) = (quadratics(places[:, k]) for k in range(3))

    def product(f: Array, g: Array, h: Array) -> Array:
        return np.einsum("ni,nj,nk->nijk", f, g, h).reshape(len(places), 27)

    return product(a, b, c), np.stack([product(da, b, c), product(a, db, c), product(a, b, dc)], axis=-1)


def cube(points: int) -> tuple[Array, Array]:
    """Gauss' rule on the cube."""
    s, w = np.polynomial.legendre.leggauss(points)
    places = np.stack([grid.ravel() for grid in np.meshgrid(s, s, s, indexing="ij")], axis=-1)
    return places, np.einsum("i,j,k->ijk", w, w, w).ravel()


@dataclasses.dataclass
class Pad:
    """Elements in a lattice over (u, v) and through the thickness.

    A place of the lattice counts elements in each direction: (i + 0.5, j + 0.5, k + 0.5) is the middle of element (i, j, k); k counts
    from the surface to the core.
    """

    u: Array  # where elements begin and end
    v: Array
    layers: int
    surface: Surface
    thickness: float
    modulus: float
    poisson: float

    def __post_init__(self) -> None:
        count = 2 * np.array(self.counts) + 1
        half = [
            np.interp(np.arange(n) / 2.0, np.arange(len(edges)), edges) for n, edges in zip(count, (self.u, self.v), strict=False)
        ]
        top, normal = self.surface.at(*np.meshgrid(*half, indexing="ij"))
        for axis in (0, 1):
            bend = np.einsum("ijk,ijk->ij", np.diff(normal, axis=axis), np.diff(top, axis=axis))
            curvature = float((bend / (np.diff(top, axis=axis) ** 2).sum(axis=2)).max())
            if curvature * self.thickness >= 1.0:
                raise Refusal(
                    f"the pad is {self.thickness:.3g} m thick, and its surface's least radius of curvature is {1.0 / curvature:.3g} m: "
                    "no core is left there; is the thickness, or the mesh's unit, another one?"
                )
        below = np.arange(count[2]) / (count[2] - 1)
        nodes = top[:, :, None] - self.thickness * below[:, None] * normal[:, :, None]
        self.nodes = nodes.reshape(-1, 3)
        # Numbers of the nodes of all elements: (elements, 27).
        number = np.arange(count.prod()).reshape(count)
        first = [2 * np.arange(n) for n in self.counts]
        start = number[np.ix_(*first)].ravel()
        self.elements = start[:, None] + number[:3, :3, :3].ravel()
        core = np.zeros(count, dtype=bool)
        core[:, :, -1] = True
        self.unknown = np.where(np.repeat(core.ravel(), 3), -1, 0)
        self.unknown[self.unknown == 0] = np.arange(np.count_nonzero(self.unknown == 0))

    @property
    def counts(self) -> tuple[int, int, int]:
        return len(self.u) - 1, len(self.v) - 1, self.layers

    @property
    def unknowns(self) -> int:
        return int(self.unknown.max()) + 1

    @cached_property
    def shear(self) -> float:
        return self.modulus / 2.0 / (1.0 + self.poisson)

    @cached_property
    def lame(self) -> float:
        return 2.0 * self.shear * self.poisson / (1.0 - 2.0 * self.poisson)

    def gradients(self, elements: Array, places: Array) -> tuple[Array, Array, Array]:
        """At places (g, 3) of the cube in each element: points, slopes of the shape functions in space (e, g, 27, 3), volumes."""
        value, slope = shapes(places)
        corner = self.nodes[self.elements[elements]]
        stretch = np.einsum("eni,gnk->egik", corner, slope)
        volume = np.linalg.det(stretch)
        if not (volume > 0.0).all():
            raise Refusal(
                "elements of the pad turn inside out: its surface is bent too much for the thickness, or its mesh is too coarse"
            )
        return np.einsum("gn,eni->egi", value, corner), np.matmul(slope, np.linalg.inv(stretch)), volume

    def pressures(self, elements: Array) -> tuple[Array, Callable[[Array], Array]]:
        """The mean dilatation, linear in each element, as a function of its displacements.

        Returns (e, 4, 81), coefficients of 1 and the three places from the middle, of which sqrt(M) is taken out so that the energy is
        their square, and what gives the dilatation (e, g, 81) at points (e, g, 3).
        """
        places, weight = cube(3)
        point, slope, volume = self.gradients(elements, places)
        middle = point.mean(axis=1)[:, None]
        size = np.cbrt(volume.mean(axis=1))[:, None, None]

        def linear(at: Array) -> Array:
            return np.concatenate([np.ones((*at.shape[:2], 1)), (at - middle) / size], axis=2)

        basis = linear(point)
        weighted = basis * (volume * weight)[..., None]
        root = np.linalg.cholesky(np.matmul(np.moveaxis(basis, 1, 2), weighted))
        work = np.matmul(np.moveaxis(weighted, 1, 2), slope.reshape(*slope.shape[:2], 81))
        reduced = np.linalg.solve(root, work)
        return reduced, lambda at: np.matmul(np.moveaxis(np.linalg.solve(root, np.moveaxis(linear(at), 1, 2)), 1, 2), reduced)

    def stiffness(self) -> sparse.csr_matrix:
        """The upper triangle of A."""
        places, weight = cube(3)
        count = len(self.elements)
        rows, columns = np.triu_indices(81)
        values = np.empty((count, len(rows)))
        for first in range(0, count, 200):
            some = np.arange(first, min(first + 200, count))
            _, slope, volume = self.gradients(some, places)
            g = slope * np.sqrt(2.0 * self.shear * volume * weight)[..., None, None]
            strain = np.zeros((len(some), len(places), 6, 27, 3))
            for i in range(3):
                strain[:, :, i, :, i] = g[..., i]
                j, k = (i + 1) % 3, (i + 2) % 3
                strain[:, :, 3 + i, :, j] = np.sqrt(0.5) * g[..., k]
                strain[:, :, 3 + i, :, k] = np.sqrt(0.5) * g[..., j]
            b = strain.reshape(len(some), -1, 81)
            c = np.sqrt(self.lame) * self.pressures(some)[0]
            matrix = np.matmul(np.moveaxis(b, 1, 2), b) + np.matmul(np.moveaxis(c, 1, 2), c)
            values[some] = matrix[:, rows, columns]
        numbers = self.unknown[(3 * self.elements[:, :, None] + np.arange(3)).reshape(count, 81)]
        at, beside = numbers[:, rows].ravel(), numbers[:, columns].ravel()
        free = (at >= 0) & (beside >= 0)
        a = sparse.coo_matrix((values.ravel()[free], (at[free], beside[free])), shape=(self.unknowns, self.unknowns)).tocsr()
        a.sort_indices()
        return a

    # Places ----------------------------------------------------------------------------------------------------------

    def split(self, place: Array) -> tuple[Array, Array]:
        """Elements (n) and places in their cubes (n, 3), of places of the lattice."""
        counts = np.array(self.counts)
        index = np.clip(np.floor(place).astype(int), 0, counts - 1)
        return np.ravel_multi_index(tuple(index.T), self.counts), 2.0 * (place - index) - 1.0

    def points(self, place: Array) -> tuple[Array, Array]:
        """Points in space (n, 3) and their derivatives by the lattice's place (n, 3, 3)."""
        element, inside = self.split(place)
        value, slope = shapes(inside)
        corner = self.nodes[self.elements[element]]
        return np.einsum("nk,nki->ni", value, corner), 2.0 * np.einsum("nki,nkj->nij", corner, slope)

    def find(self, points: Array, above: Array, depth: Array) -> Array:
        """The lattice's places of points in space, from the surface above them and their depth: Newton's rule."""
        uv = self.surface.rays.coordinates(above)
        place = np.stack(
            [
                np.interp(uv[:, 0], self.u, np.arange(len(self.u))),
                np.interp(uv[:, 1], self.v, np.arange(len(self.v))),
                np.clip(depth / self.thickness, 0.0, 1.0) * self.layers,
            ],
            axis=-1,
        )
        for _ in range(40):
            at, slope = self.points(place)
            step = np.linalg.solve(slope, (points - at)[..., None])[..., 0]
            place = np.clip(place + np.clip(step, -1.0, 1.0), -1.0, np.array(self.counts) + 1.0)
            if np.abs(step).max() < 1e-12:
                break
        return place

    # Readings --------------------------------------------------------------------------------------------------------

    def row(self, place: Array, quantity: str, axes: Array) -> tuple[Array, Array]:
        """Degrees of freedom (81) and their weights in the reading at one place of the lattice, in one element."""
        unit, first, second = QUANTITIES[quantity]
        element, inside = self.split(place[None])
        degrees = (3 * self.elements[element[0]][:, None] + np.arange(3)).ravel()
        if unit == "m":
            return degrees, np.outer(shapes(inside)[0][0], axes[first]).ravel()
        point, slope, _ = self.gradients(element, inside)
        along = slope[0, 0] @ axes.T  # (27, axis)
        strain = 0.5 * (np.outer(along[:, second], axes[first]) + np.outer(along[:, first], axes[second])).ravel()
        if unit == "1":
            return degrees, -strain * (1.0 if first == second else 2.0)
        stress = 2.0 * self.shear * strain
        if first == second:
            stress = stress + self.lame * self.pressures(element)[1](point)[0, 0]
        return degrees, -stress

    def reading(self, place: Array, quantity: str, axes: Array) -> tuple[Array, Array]:
        """As `row`, the mean of both sides where a place lies between elements, whose stresses and strains differ."""
        if QUANTITIES[quantity][0] == "m":
            return self.row(place, quantity, axes)
        sides = []
        for s, n in zip(place, self.counts, strict=True):
            between = abs(s - round(s)) < 1e-7 and 0 < round(s) < n
            sides.append([round(s) - 1e-9, round(s) + 1e-9] if between else [s])
        rows = [self.row(np.array([a, b, c]), quantity, axes) for a in sides[0] for b in sides[1] for c in sides[2]]
        return np.concatenate([degrees for degrees, _ in rows]), np.concatenate([weights for _, weights in rows]) / len(rows)


def spread(low: float, high: float, count: int, inner: float, growth: float) -> Array:
    """Ends of `count` elements between low and high, equal within `inner` of the ends' distance to the middle, `growth` times as long
    at the ends."""
    s = np.linspace(-1.0, 1.0, count + 1)
    beyond = np.clip(np.abs(s) - inner, 0.0, None)
    s = np.sign(s) * (np.abs(s) + 0.5 * (growth - 1.0) * beyond**2 / max(1e-9, 1.0 - inner))
    return 0.5 * (low + high) + 0.5 * (high - low) * s / s[-1]


def pieces(edges: Array, ends: Array, points: int) -> tuple[Array, Array, Array]:
    """Gauss' rule between all ends of elements and cells: the cell of each point, its place in elements, and its weight in these."""
    both = np.union1d(edges[(edges > ends[0]) & (edges < ends[-1])], ends)
    # Two that differ by rounding are one.
    both = both[np.concatenate([[True], np.diff(both) > 1e-9 * (ends[-1] - ends[0])])]
    both[-1] = ends[-1]
    s, w = np.polynomial.legendre.leggauss(points)
    cell = np.clip(np.searchsorted(ends, (both[1:] + both[:-1]) / 2.0) - 1, 0, len(ends) - 2)
    place = np.interp(both, edges, np.arange(len(edges)))
    middle, half = (place[1:] + place[:-1])[:, None] / 2.0, np.diff(place)[:, None] / 2.0
    return np.repeat(cell, points), (middle + half * s).ravel(), (half * w).ravel()


@dataclasses.dataclass
class Cells:
    """Quadrilaterals of the surface, rows along e_y, columns along e_z, row after row."""

    pad: Pad
    u: Array
    v: Array
    reference: Array

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.u) - 1, len(self.v) - 1

    @property
    def count(self) -> int:
        return self.shape[0] * self.shape[1]

    def lattice(self, u: Array, v: Array) -> Array:
        """Places of the pad's lattice on its surface: (n, 3)."""
        a, b = np.interp(u, self.pad.u, np.arange(len(self.pad.u))), np.interp(v, self.pad.v, np.arange(len(self.pad.v)))
        grid = np.meshgrid(a, b, indexing="ij")
        return np.stack([grid[0].ravel(), grid[1].ravel(), np.zeros(grid[0].size)], axis=-1)

    def vertices(self) -> tuple[Array, Array]:
        """Points, and the four of each cell, counterclockwise from outside."""
        rows, columns = self.shape
        number = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
        corners = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1)
        return self.pad.points(self.lattice(self.u, self.v))[0], corners.reshape(-1, 4)

    def frames(self) -> Array:
        """At the cells' middles: (k, 3, 3)."""
        middle = [(ends[1:] + ends[:-1]) / 2.0 for ends in (self.u, self.v)]
        _, slope = self.pad.points(self.lattice(*middle))
        across = np.cross(slope[:, :, 1], slope[:, :, 0])
        return frames(across / np.linalg.norm(across, axis=1)[:, None], self.reference, lambda i: f"cell {i}")

    def loads(self) -> tuple[sparse.csr_matrix, Array]:
        """The nodal forces of unit tractions, (3 cells, 3 nodes): all p, then q_y, q_z; and the cells' areas.

        Unit tractions act along the local frame of each point, so that sums are exact: those of p are minus the area vector.
        """
        row, a, wa = pieces(self.pad.u, self.u, 4)
        column, b, wb = pieces(self.pad.v, self.v, 4)
        place = np.stack([np.repeat(a, len(b)), np.tile(b, len(a)), np.zeros(len(a) * len(b))], axis=-1)
        cell = (row[:, None] * self.shape[1] + column).ravel()
        _, slope = self.pad.points(place)
        across = np.cross(slope[:, :, 1], slope[:, :, 0])
        size = np.linalg.norm(across, axis=1)
        area = size * np.outer(wa, wb).ravel()
        axes = frames(across / size[:, None], self.reference, lambda i: f"cell {cell[i]}")
        element, inside = self.pad.split(place)
        value, _ = shapes(inside)
        value = value.reshape(-1, 9, 3)[:, :, 0]  # the others are 0 at the surface
        node = self.pad.elements[element].reshape(-1, 9, 3)[:, :, 0]
        work = np.einsum("n,nk,nti->ntki", area, value, axes)
        at = np.broadcast_to((cell[:, None] + self.count * np.arange(3))[:, :, None, None], work.shape)
        degree = np.broadcast_to((3 * node[:, :, None] + np.arange(3))[:, None], work.shape)
        loads = sparse.coo_matrix((work.ravel(), (at.ravel(), degree.ravel())), shape=(3 * self.count, 3 * len(self.pad.nodes)))
        return loads.tocsr(), np.bincount(cell, area, self.count)


# --- Solving ----------------------------------------------------------------------------------------------------------


def by_pardiso(a: sparse.csr_matrix) -> Callable[[Array], Array]:
    import pypardiso

    solver = pypardiso.PyPardisoSolver(mtype=2)  # symmetric, positive definite: its upper triangle
    solver.factorize(a)
    return lambda b: solver.solve(a, b)


def by_cholmod(a: sparse.csr_matrix) -> Callable[[Array], Array]:
    from sksparse import cholmod

    solve = cholmod.cholesky(a.T.tocsc())  # reads the lower triangle
    if not callable(solve):
        raise ImportError("scikit-sparse 0.4 is meant")
    return solve


def by_superlu(a: sparse.csr_matrix) -> Callable[[Array], Array]:
    whole = (a + sparse.triu(a, 1).T).tocsc()
    return linalg.splu(whole, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}).solve


SOLVERS = {"pardiso": by_pardiso, "cholmod": by_cholmod, "superlu": by_superlu}


def factor(a: sparse.csr_matrix, solver: str) -> tuple[str, Callable[[Array], Array]]:
    """The solver's name and what solves A x = b for columns b; "auto": the first that is installed."""
    for name in SOLVERS if solver == "auto" else [solver]:
        try:
            return name, SOLVERS[name](a)
        except ImportError:
            if solver != "auto":
                package = {"pardiso": "pypardiso", "cholmod": "scikit-sparse, version 0.4"}[name]
                raise Refusal(f"--solver {name} needs the package {package}: install it, or leave the option out") from None
        except MemoryError:
            raise
        except Exception as error:  # each solver has its own
            raise Refusal(f"{name} finds no factor ({error}): give another --solver, or fewer --elements") from None
    raise AssertionError("SciPy has SuperLU")


# --- All of it --------------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Request:
    """What a kernel is made of; lengths in metres. None: the rule of `--help`."""

    taxels: Taxels
    surface: Callable[[Taxels, Array], Surface]  # from the taxels and the frame in their middle
    thickness: float
    modulus: float
    poisson: float
    frame: str | None = None  # of displacements: "sensor" or "local"
    reference: tuple[float, float, float] = (0.0, 1.0, 0.0)
    cells: tuple[int, int] | None = None
    elements: tuple[int, int, int] | None = None
    margin: float | None = None
    edge: float | None = None
    width: float = 0.0
    solver: str = "auto"

    def check(self) -> None:
        if not (np.isfinite(self.thickness) and 1e-5 <= self.thickness <= 1.0):
            raise Refusal(
                f"the thickness is {self.thickness:g} m: it must lie between 1e-5 and 1 m; --length-unit says what lengths are in"
            )
        if not (np.isfinite(self.modulus) and self.modulus > 0.0):
            raise Refusal(f"Young's modulus is {self.modulus:g} Pa: it must be above 0")
        if not 0.0 <= self.poisson <= MOST_POISSON:
            raise Refusal(
                f"Poisson's ratio is {self.poisson:g}: it must lie between 0 and {MOST_POISSON}. Displacements alone are solved for, and at 0.5 "
                "the pressure is no function of them; give 0.4999 for rubber that keeps its volume"
            )
        for what, value in (("margin", self.margin), ("edge", self.edge), ("width", self.width)):
            if value is not None and not (np.isfinite(value) and value >= 0.0):
                raise Refusal(f"--{what} is {value:g} m: it must be 0 or more")
        reference = np.array(self.reference)
        if not (np.isfinite(reference).all() and np.linalg.norm(reference) > 0.0):
            raise Refusal("--reference must be a direction: three finite numbers that are not all 0")
        for name, depth in zip(self.taxels.names, self.taxels.depth, strict=True):
            if depth > self.thickness * (1.0 + 1e-9):
                raise Refusal(
                    f"taxel {name} is {depth:.4g} m deep, and the pad is {self.thickness:.4g} m thick: it would lie in the core"
                )
        for i, quantity in self.taxels.readings():
            if QUANTITIES[quantity][0] == "m":
                if self.frame is None:
                    raise Refusal(
                        f"taxel {self.taxels.names[i]} reads {quantity}: say along which axes with --frame sensor (the file's x, y, z) or "
                        "--frame local (x into the pad, y and z along its surface)"
                    )
                if self.taxels.depth[i] > self.thickness * (1.0 - 1e-6):
                    raise Refusal(
                        f"taxel {self.taxels.names[i]} reads {quantity} at the core, where nothing moves: its depth must be less than the thickness"
                    )


def ranges(request: Request, surface: Surface) -> tuple[Pad, Cells]:
    """The elements and the cells over the taxels."""
    taxels, h = request.taxels, request.thickness
    uv = surface.rays.coordinates(taxels.above)
    for i in np.flatnonzero(~(np.abs(uv * surface.rays.curvature).max(axis=1) < STEEPEST)):
        raise Refusal(
            f"taxel {taxels.names[i]} lies more than {np.degrees(STEEPEST):.0f} degrees around the pad from the middle of the taxels: "
            "give the taxels of one side at a time"
        )
    margin = float(taxels.depth.max()) if request.margin is None else request.margin
    with np.errstate(divide="ignore"):
        room = float((STEEPEST / np.abs(surface.rays.curvature) - np.abs(uv).max(axis=0)).min())
    edge = max(margin, min(4.0 * h, room)) if request.edge is None else request.edge
    if edge > room:
        raise Refusal(
            f"the pad would reach around more than {2 * np.degrees(STEEPEST):.0f} degrees of its surface, where the lattice's rays miss it: --edge may "
            f"be {room:.3g} m at most, and --margin too; or give the taxels of one side at a time"
        )
    if edge < margin:
        raise Refusal(
            f"--edge is {edge:g} m and --margin {margin:g} m: cells cannot reach beyond the pad's edge; make --margin less"
        )
    low, high = uv.min(axis=0), uv.max(axis=0)
    extent = high - low + 2.0 * margin
    if extent.min() <= 0.0:
        raise Refusal("the cells have no area: the taxels lie in a row, and --margin is 0; give a margin")
    side = float(np.clip(taxels.depth.mean(), h / 4.0, h / 2.0))
    rows, columns = request.cells or [max(2, int(np.ceil(length / side - 1e-9))) for length in extent]
    if min(rows, columns) < 1 or rows * columns > 40_000:
        raise Refusal(f"there would be {rows} x {columns} cells: give --cells ROWSxCOLUMNS with 1 to 40,000 in all")
    whole = extent + 2.0 * (edge - margin)
    counts = request.elements or [*(max(4, int(np.ceil(1.4 * side / h))) for side in whole), 3]
    if min(counts) < 1:
        raise Refusal(f"there would be {' x '.join(map(str, counts))} elements: give one at least in each direction")
    unknowns = 3 * (2 * counts[0] + 1) * (2 * counts[1] + 1) * 2 * counts[2]
    if unknowns > MOST_UNKNOWNS:
        raise Refusal(
            f"{counts[0]} x {counts[1]} x {counts[2]} elements have {unknowns:,} unknowns, which takes tens of gigabytes: give fewer --elements "
            f"(at most {MOST_UNKNOWNS:,} unknowns), or make --edge less"
        )
    ends = [spread(low[k] - edge, high[k] + edge, counts[k], extent[k] / whole[k], 2.0) for k in range(2)]
    reference = np.array(request.reference) / np.linalg.norm(request.reference)
    pad = Pad(ends[0], ends[1], counts[2], surface, h, request.modulus, request.poisson)
    cells = [np.linspace(low[k] - margin, high[k] + margin, n + 1) for k, n in enumerate((rows, columns))]
    return pad, Cells(pad, cells[0], cells[1], reference)


def places_of(request: Request, pad: Pad, axes: Array) -> tuple[Array, Array]:
    """Where each taxel reads, in the pad's lattice (taxels, points, 3), and the points' weights."""
    taxels = request.taxels
    s, w = np.polynomial.legendre.leggauss(4) if request.width else (np.zeros(1), np.full(1, 2.0))
    offset = np.stack([grid.ravel() for grid in np.meshgrid(s, s, indexing="ij")], axis=-1) * request.width / 2.0
    shift = offset @ axes[:, 1:]  # (taxels, points, 3)
    above = taxels.above[:, None] + shift
    points = taxels.place[:, None] + shift
    depth = np.broadcast_to(taxels.depth[:, None], points.shape[:2])
    place = pad.find(points.reshape(-1, 3), above.reshape(-1, 3), depth.ravel()).reshape(points.shape)
    counts = np.array(pad.counts)
    off = np.linalg.norm(pad.points(place.reshape(-1, 3))[0].reshape(points.shape) - points, axis=2)
    mean = place.mean(axis=1)
    found = mean[:, 2] / pad.layers * pad.thickness
    _, slope = pad.points(mean)
    out = np.cross(slope[:, :, 1], slope[:, :, 0])
    turned = np.einsum("ij,ij->i", out, taxels.normal) / np.linalg.norm(out, axis=1)
    for i, name in enumerate(taxels.names):
        if turned[i] < 0.0:
            raise Refusal(f"the normal of taxel {name} points into the pad: normals point out of it")
        if turned[i] < np.cos(np.radians(20.0)):
            raise Refusal(
                f"the normal of taxel {name} is {np.degrees(np.arccos(turned[i])):.0f} degrees off the surface's: do both have the same axes?"
            )
        if off[i].max() > 1e-6 * pad.thickness or (place[i, :, :2] < -1e-9).any() or (place[i, :, :2] > counts[:2] + 1e-9).any():
            raise Refusal(
                f"taxel {name} lies outside of the pad"
                + (", with half of --width: make --edge more, or --width less" if request.width else "")
            )
        if abs(found[i] - taxels.depth[i]) > 0.05 * pad.thickness:
            raise Refusal(
                f"taxel {name} lies {found[i]:.4g} m below the surface, and its depth is said to be {taxels.depth[i]:.4g} m: x, y, z is where it "
                "reads, not the surface above it; or the surface is another one"
            )
    return np.clip(place, 0.0, counts), np.outer(w, w).ravel() / 4.0


def make_kernel(request: Request, tell: Callable[[str], None] = lambda _: None) -> dict[str, Array]:
    """The arrays of k.npz. @throws Refusal"""
    request.check()
    started = time.perf_counter()
    taxels = request.taxels
    reference = np.array(request.reference) / np.linalg.norm(request.reference)
    axes = frames(taxels.normal, reference, lambda i: f"taxel {taxels.names[i]}")
    surface = request.surface(taxels, middle_frame(taxels, reference))
    pad, cells = ranges(request, surface)
    readings = taxels.readings()
    tell(
        f"{len(readings)} readings of {len(taxels.names)} taxels, {cells.shape[0]} x {cells.shape[1]} cells, "
        f"{' x '.join(map(str, pad.counts))} elements, {pad.unknowns:,} unknowns"
    )
    place, weight = places_of(request, pad, axes)
    loads, areas = cells.loads()
    free = np.flatnonzero(pad.unknown >= 0)
    work = loads[:, free]
    kernel = np.empty((len(readings), 3 * cells.count))
    a = pad.stiffness()
    across = sparse.triu(a, 1).T.tocsr()
    name, solve = factor(a, request.solver)
    built = time.perf_counter()
    tell(f"matrix and factor by {name}: {built - started:.1f} s")
    most = 0.0
    for first in range(0, len(readings), 64):
        some = readings[first : first + 64]
        right = np.zeros((len(pad.unknown), len(some)))
        for k, (i, quantity) in enumerate(some):
            along = np.eye(3) if request.frame == "sensor" and QUANTITIES[quantity][0] == "m" else axes[i]
            for at, share in zip(place[i], weight, strict=True):
                degrees, values = pad.reading(at, quantity, along)
                np.add.at(right[:, k], degrees, share * values)
        right = right[free]
        solved = np.asarray(solve(right)).reshape(right.shape)
        missed = np.linalg.norm(a @ solved + across @ solved - right, axis=0) / np.linalg.norm(right, axis=0)
        most = max(most, float(missed.max()))
        kernel[first : first + 64] = (work @ solved).T
    if not (np.isfinite(kernel).all() and most < 1e-7):
        raise Refusal(
            f"the elements' equations are not solved: they miss {most:.1g} of their right sides; give another --solver, or a smaller --poisson-ratio"
        )
    tell(
        f"{len(readings)} solves: {time.perf_counter() - built:.1f} s; {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB in all"
    )
    vertices, corners = cells.vertices()
    # The work of the tractions in a shift and in a turn of the whole pad: forces and moments, to rounding.
    turn = np.zeros((3, 3, *pad.nodes.shape[:1]))
    for axis in range(3):
        turn[axis] = np.cross(np.eye(3)[axis], pad.nodes).T
    moved = np.concatenate([np.tile(np.eye(3), (len(pad.nodes), 1)), turn.transpose(2, 1, 0).reshape(-1, 3)], axis=1)
    sums = (loads @ moved).reshape(3, cells.count, 2, 3).transpose(2, 1, 0, 3)
    return {
        "K": kernel,
        "vertices": vertices,
        "cells": corners.astype(np.int64),
        "frames": cells.frames(),
        "readings": np.array([f"{quantity}_{taxels.names[i]}" for i, quantity in readings]),
        "units": np.array([QUANTITIES[quantity][0] for _, quantity in readings]),
        "frame": np.array(request.frame or "local"),
        "made_by": np.array(
            f"tools/pad_kernel.py: {' x '.join(map(str, pad.counts))} elements of 27 nodes, {pad.unknowns} unknowns, {type(surface).__name__.lower()}"
        ),
        "youngs_modulus": np.array(request.modulus),
        "poisson_ratio": np.array(request.poisson),
        "thickness": np.array(request.thickness),
        "shape": np.array(cells.shape, dtype=np.int64),
        "areas": areas,
        "F": np.ascontiguousarray(sums[0]),
        "M": np.ascontiguousarray(sums[1]),
    }


def write(path: Path, arrays: dict[str, Array]) -> None:
    """The file is whole or not there."""
    partial = path.with_name(path.name + ".part")
    try:
        with partial.open("wb") as file:
            np.savez(file, **arrays)  # numbers and text alone: nothing is pickled
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


# --- Command line -----------------------------------------------------------------------------------------------------


def counts(count: int) -> Callable[[str], tuple[int, ...]]:
    def numbers(text: str) -> tuple[int, ...]:
        values = tuple(int(word) for word in text.lower().split("x"))
        if len(values) != count or min(values) < 1:
            raise ValueError
        return values

    numbers.__name__ = "list of " + "x".join("ABC"[:count])  # in argparse's message
    return numbers


def floats(count: int) -> Callable[[str], tuple[float, ...]]:
    def numbers(text: str) -> tuple[float, ...]:
        values = tuple(float(word) for word in text.split(","))
        if len(values) != count or not np.isfinite(values).all():
            raise ValueError
        return values

    numbers.__name__ = f"list of {count} numbers with commas between"
    return numbers


def parser() -> argparse.ArgumentParser:
    options = argparse.ArgumentParser(
        prog="tools/pad_kernel.py",
        description="Writes k.npz: what taxels in a curved soft pad on a rigid core read under a unit traction on each cell of its surface, by "
        "finite elements. docs/kernels.md explains it step by step.",
        epilog="Lengths, the files' and the options', are in --length-unit; K is in SI: m/Pa, Pa/Pa, 1/Pa.",
    )
    options.add_argument(
        "taxels",
        type=Path,
        help="CSV: name,x,y,z,nx,ny,nz,depth,reads; x, y, z is where a taxel reads, nx, ny, nz the outward unit normal",
    )
    shape = options.add_mutually_exclusive_group(required=True)
    shape.add_argument(
        "--sphere",
        nargs="?",
        const="fitted",
        metavar="X,Y,Z,R",
        help="the outer surface is a sphere: fitted to the taxels, or centre and radius (R < 0: a hole)",
    )
    shape.add_argument(
        "--surface",
        type=Path,
        metavar="MESH.obj",
        help="the outer surface, triangles or quadrilaterals, counterclockwise seen from outside",
    )
    options.add_argument(
        "--thickness", type=float, required=True, help="of the pad, from its surface to the core along the normal"
    )
    options.add_argument(
        "--youngs-modulus", type=float, required=True, metavar="PA", help="of the pad [Pa], whatever --length-unit is"
    )
    options.add_argument("--poisson-ratio", type=float, required=True, metavar="NU", help=f"0 to {MOST_POISSON}; 0.5 is refused")
    options.add_argument("--length-unit", choices=LENGTHS, default="m", help="of the files and of the options (m)")
    options.add_argument(
        "--reads",
        default="",
        help='what taxels read where the file does not say it: "displacement_x displacement_y displacement_z"',
    )
    options.add_argument(
        "--frame",
        choices=("sensor", "local"),
        help="displacements are along the file's axes, or along the taxel's own; must be said",
    )
    options.add_argument(
        "--reference", type=floats(3), default=(0.0, 1.0, 0.0), metavar="X,Y,Z", help="e_y is this direction made tangent (0,1,0)"
    )
    options.add_argument(
        "--cells",
        type=counts(2),
        metavar="ROWSxCOLUMNS",
        help="rows along e_y (the taxels' mean depth a side, but a quarter to a half of the thickness)",
    )
    options.add_argument(
        "--elements", type=counts(3), metavar="ROWSxCOLUMNSxLAYERS", help="(0.6 of the thickness a side in the middle, 3 layers)"
    )
    options.add_argument(
        "--margin", type=float, help="how far cells reach beyond the outermost taxels, along the surface (their largest depth)"
    )
    options.add_argument(
        "--edge", type=float, help="how far the pad itself does; its edges are free (4 thicknesses, less where it goes around)"
    )
    options.add_argument(
        "--width",
        type=float,
        default=0.0,
        help="readings are means over a square of this side, along the surface (0: at a point)",
    )
    options.add_argument(
        "--solver", choices=("auto", *SOLVERS), default="auto", help="auto: the first that is installed; SuperLU is SciPy's"
    )
    options.add_argument("-o", "--output", type=Path, default=Path("k.npz"), help="(k.npz)")
    options.add_argument("-q", "--quiet", action="store_true", help="say nothing of the progress")
    return options


def request_of(given: argparse.Namespace) -> Request:
    unit = LENGTHS[given.length_unit]

    def scaled(value: float | None) -> float | None:
        return None if value is None else value * unit

    taxels = read_taxels(given.taxels, given.length_unit, given.reads)
    thickness = given.thickness * unit
    sphere = None
    if given.sphere not in (None, "fitted"):
        try:
            sphere = np.array(floats(4)(given.sphere)) * unit
        except ValueError:
            raise Refusal(f"--sphere={given.sphere}: it takes centre and radius, X,Y,Z,R, or nothing") from None
        if sphere[3] == 0.0:
            raise Refusal("--sphere: the radius is 0")

    def surface(of: Taxels, axes: Array) -> Surface:
        if given.surface is not None:
            return Mesh(given.surface, unit, of, axes)
        if sphere is not None:
            return Sphere(sphere[:3], float(sphere[3]), axes)
        return Sphere(*Sphere.fitted(of, thickness), axes)

    return Request(
        taxels=taxels, surface=surface, thickness=thickness, modulus=given.youngs_modulus, poisson=given.poisson_ratio, frame=given.frame,
        reference=given.reference, cells=given.cells, elements=given.elements, margin=scaled(given.margin), edge=scaled(given.edge),
        width=given.width * unit, solver=given.solver,
    )  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    given = parser().parse_args(arguments)

    def tell(words: str) -> None:
        if not given.quiet:
            print(words, file=sys.stderr, flush=True)

    try:
        if not given.output.parent.is_dir():
            raise Refusal(f"{given.output}: there is no folder {given.output.parent}")
        arrays = make_kernel(request_of(given), tell)
        write(given.output, arrays)
    except (Refusal, OSError, csv.Error) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except UnicodeDecodeError as error:
        print(f"error: {given.taxels}: it is no text in UTF-8: {error.reason}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    except MemoryError:
        print("error: there is not enough memory for so many elements: give fewer --elements", file=sys.stderr)
        return 1
    tell(f"{given.output}: K {arrays['K'].shape[0]} x {arrays['K'].shape[1]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

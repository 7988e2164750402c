"""tools/pad_kernel.py: kernels of curved pads by finite elements, beside laws, the flat layer's kernel and the ball's exact series."""

from __future__ import annotations

import csv
import dataclasses
import importlib.util
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tactile_net as tn

PROJECT = Path(__file__).resolve().parents[2]
CAP = PROJECT / "scenes/recorded/curved-pad"
OF = ["displacement_x", "displacement_y", "displacement_z"]
H, R = 4e-3, 30e-3

specification = importlib.util.spec_from_file_location("pad_kernel", PROJECT / "tools/pad_kernel.py")
assert specification and specification.loader
tool: Any = importlib.util.module_from_spec(specification)
sys.modules["pad_kernel"] = tool  # dataclasses look there
specification.loader.exec_module(tool)

Floats = np.ndarray[Any, np.dtype[np.float64]]


def taxels_on_ball(angles: Floats, depth: float, reads: list[str], radius: float = R) -> Any:
    """A square of taxels at equal angles about two axes."""
    a, b = (grid.ravel() for grid in np.meshgrid(angles, angles, indexing="ij"))
    normal = np.stack([np.tan(b), np.tan(a), np.ones_like(a)], axis=1)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    names = [f"t{i}" for i in range(len(a))]
    return tool.Taxels(names, (radius - depth) * normal, normal, np.full(len(a), depth), [reads] * len(a))


def ball(radius: float = R) -> Callable[..., Any]:
    return lambda taxels, axes: tool.Sphere(np.zeros(3), radius, axes)


def request(taxels: Any, **given: Any) -> Any:
    return tool.Request(
        taxels, **{"surface": ball(), "thickness": H, "modulus": 0.25e6, "poisson": 0.48, "frame": "local"} | given
    )


def small(**given: Any) -> Any:
    taxels = given.pop("taxels", None) or taxels_on_ball(
        np.linspace(-0.1, 0.1, 3), 1.6e-3, [*OF, "stress_x", "shear_xy", "shear_xz"]
    )
    return request(taxels, **{"cells": (6, 6), "elements": (6, 6, 2), "edge": 8e-3, "margin": 2e-3} | given)


def write_obj(path: Path, vertices: Floats, faces: list[list[int]]) -> Path:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    path.write_text("\n".join([*lines, *("f " + " ".join(str(i + 1) for i in face) for face in faces)]) + "\n")
    return path


def grid_of(u: Floats, v: Floats, place: Callable[[Floats, Floats], Floats]) -> tuple[Floats, list[list[int]]]:
    """Quadrilaterals, counterclockwise seen from where u x v points."""
    a, b = np.meshgrid(u, v, indexing="ij")
    n = len(v)
    faces = [[i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1] for i in range(len(u) - 1) for j in range(n - 1)]
    return place(a.ravel(), b.ravel()), faces


def on_ball(a: Floats, b: Floats) -> Floats:
    direction = np.stack([np.tan(a), np.tan(b), np.ones_like(a)], axis=1)
    return R * direction / np.linalg.norm(direction, axis=1)[:, None]


# --- Laws -------------------------------------------------------------------------------------------------------------


def test_a_uniform_strain_is_exact_on_curved_elements() -> None:
    surface = tool.Sphere(np.zeros(3), 10e-3, np.eye(3)[[1, 0, 2]])
    pad = tool.Pad(np.linspace(-4e-3, 5e-3, 4), np.linspace(-3e-3, 3e-3, 4), 3, surface, 3e-3, 2.0, 0.45)
    pad.unknown = np.arange(3 * len(pad.nodes))  # no core holds it
    a = pad.stiffness()
    a = a + tool.sparse.triu(a, 1).T
    slope = np.random.default_rng(1).normal(size=(3, 3))
    strain = (slope + slope.T) / 2.0
    stress = 2.0 * pad.shear * strain + pad.lame * np.trace(strain) * np.eye(3)
    u = (pad.nodes @ slope.T).ravel()
    force = (a @ u).reshape(*(2 * np.array(pad.counts) + 1), 3)
    scale = np.abs(a @ np.abs(u)).max()
    assert np.abs(force[1:-1, 1:-1, 1:-1]).max() < 1e-13 * scale  # inside nothing pulls
    _, weight = tool.cube(3)
    volume = pad.gradients(np.arange(len(pad.elements)), tool.cube(3)[0])[2] @ weight
    assert u @ force.ravel() == pytest.approx(np.sum(stress * strain) * volume.sum(), rel=1e-12)
    assert np.abs(a @ np.tile([1.0, 2.0, 3.0], len(pad.nodes))).max() < 1e-13 * np.abs(a).max()  # a shift costs nothing
    # The surface's forces are those of its tractions, and every reading is exact.
    cells = tool.Cells(pad, pad.u, pad.v, np.array([0.0, 1.0, 0.0]))
    axes = tool.frames(np.array([[0.36, 0.48, 0.8]]), cells.reference, str)[0]
    place = np.array([1.7, 2.0, 1.3])
    for quantity, (unit, i, j) in tool.QUANTITIES.items():
        degrees, weights = pad.reading(place, quantity, axes)
        exact = -(axes @ (stress if unit == "Pa" else strain) @ axes.T)[i, j] * (2.0 if unit == "1" and i != j else 1.0)
        if unit == "m":
            exact = axes[i] @ slope @ pad.points(place[None])[0][0]
        assert weights @ u[degrees] == pytest.approx(exact, rel=1e-10, abs=1e-10), quantity
    top = force[1:-1, 1:-1, 0].sum(axis=(0, 1))
    loads, _ = cells.loads()
    normal_load = loads.toarray().reshape(3, cells.count, -1, 3)
    inner = np.zeros(2 * np.array(pad.counts) + 1, dtype=bool)
    inner[1:-1, 1:-1, 0] = True
    # Minus the sum over cells of p's nodal vectors is the area vector that these nodes bear.
    assert np.allclose(
        stress @ -normal_load[0].sum(axis=0)[inner.ravel()].sum(axis=0), top, rtol=1e-9, atol=1e-9 * np.abs(top).max()
    )


def test_a_row_of_k_is_what_loads_cause() -> None:
    asked = small()
    arrays = tool.make_kernel(asked)
    pad, cells = tool.ranges(asked, asked.surface(asked.taxels, tool.middle_frame(asked.taxels, np.array([0.0, 1.0, 0.0]))))
    a = pad.stiffness()
    whole = (a + tool.sparse.triu(a, 1).T).tocsc()
    load = 3 * cells.count // 2 + 4
    free = pad.unknown >= 0
    moved = np.zeros(len(free))
    moved[free] = tool.linalg.spsolve(whole, cells.loads()[0].toarray()[load, free])
    axes = tool.frames(asked.taxels.normal, cells.reference, str)
    place, _ = tool.places_of(asked, pad, axes)
    for row, (i, quantity) in enumerate(asked.taxels.readings()):
        degrees, weights = pad.reading(place[i, 0], quantity, axes[i])
        assert weights @ moved[degrees] == pytest.approx(
            arrays["K"][row, load], rel=1e-8, abs=1e-9 * np.abs(arrays["K"][row]).max()
        )


def test_a_symmetric_pad_has_a_symmetric_kernel() -> None:
    arrays = tool.make_kernel(small(elements=(7, 6, 2)))
    names = ["displacement_x", "displacement_y", "displacement_z", "stress_x", "shear_xy", "shear_xz"]
    k = arrays["K"].reshape(len(names), 3, 3, 3, 6, 6)  # quantity, taxels along y and z, component, cells
    for axis, letter in ((0, "y"), (1, "z")):
        sign = np.array([-1.0 if name.rpartition("_")[2].count(letter) else 1.0 for name in names])
        turned = np.array([1.0, -1.0 if letter == "y" else 1.0, -1.0 if letter == "z" else 1.0])
        mirror = np.flip(k, (1 + axis, 4 + axis)) * sign[:, None, None, None, None, None] * turned[:, None, None]
        for quantity in range(len(names)):
            assert np.abs(k[quantity] - mirror[quantity]).max() < 1e-9 * np.abs(k[quantity]).max(), names[quantity]
    assert np.abs(k[0] - np.flip(k[0], 1)).max() > 0.1 * np.abs(k[0]).max()  # and is no constant


def test_forces_and_moments_are_those_of_the_surface() -> None:
    asked = small()
    arrays = tool.make_kernel(asked)
    pad, cells = tool.ranges(asked, asked.surface(asked.taxels, tool.middle_frame(asked.taxels, np.array([0.0, 1.0, 0.0]))))
    # Along the rim of the cells: half of the integral of x cross dx is the area vector.
    area = np.zeros(3)
    for axis, edges, ends, fixed in ((0, pad.u, cells.u, cells.v), (1, pad.v, cells.v, cells.u)):
        _, place, weight = tool.pieces(edges, ends, 3)
        other = np.interp(fixed[[0, -1]], (pad.v, pad.u)[axis], np.arange(len((pad.v, pad.u)[axis])))
        for side, sign in zip(other, (1.0, -1.0), strict=True):
            at = np.zeros((len(place), 3))
            at[:, axis], at[:, 1 - axis] = place, side
            points, slope = pad.points(at)
            area += 0.5 * sign * (-1.0 if axis == 0 else 1.0) * weight @ np.cross(points, slope[:, :, axis])
    total = arrays["F"][:, 0].sum(axis=0)
    assert area[2] > 0.9 * arrays["areas"].sum()
    assert np.abs(total + area).max() < 1e-12 * area[2]
    # Of a ball: its pressure turns nothing about its centre, and its area is that of great circles' lattice.
    assert np.abs(arrays["M"][:, 0]).max() < 1e-5 * R * arrays["areas"].max()
    tangent = np.tan(cells.u[[0, -1]] / R)
    solid = 4.0 * np.arctan(tangent[1] ** 2 / np.sqrt(1.0 + 2.0 * tangent[1] ** 2))
    assert tangent[0] == pytest.approx(-tangent[1]) and arrays["areas"].sum() == pytest.approx(solid * R**2, rel=1e-4)
    _, finer = tool.ranges(small(elements=(24, 24, 1)), ball()(asked.taxels, tool.middle_frame(asked.taxels, cells.reference)))
    assert finer.loads()[1].sum() == pytest.approx(solid * R**2, rel=5e-6)
    # Of small cells force and moment are those in their middles.
    middle = arrays["vertices"][arrays["cells"]].mean(axis=1)
    near = arrays["frames"] * arrays["areas"][:, None, None]
    assert np.abs(arrays["F"] - near).max() < 2e-3 * np.abs(near).max()
    turning = np.cross(middle[:, None], near)
    assert np.abs(arrays["M"] - turning).max() < 2e-3 * np.abs(turning).max()
    for k, corners in enumerate(arrays["vertices"][arrays["cells"]]):  # counterclockwise from outside
        across = np.cross(corners[2] - corners[0], corners[3] - corners[1])
        assert -arrays["frames"][k, 0] @ across / 2.0 == pytest.approx(arrays["areas"][k], rel=0.01)
    assert np.allclose(arrays["frames"] @ arrays["frames"].transpose(0, 2, 1), np.eye(3), atol=1e-14)


@pytest.mark.parametrize("frame", ["local", "sensor"])
def test_a_pad_elsewhere_in_the_frame_is_the_same_pad(frame: str) -> None:
    asked = small(frame=frame)
    arrays = tool.make_kernel(asked)
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    shift = np.array([0.02, -0.01, 0.03])
    old = asked.taxels
    moved = dataclasses.replace(old, place=old.place @ turn.T + shift, normal=old.normal @ turn.T)
    again = tool.make_kernel(
        dataclasses.replace(
            asked, taxels=moved, surface=lambda _, axes: tool.Sphere(shift, R, axes), reference=tuple(turn @ [0.0, 1.0, 0.0])
        )
    )
    k, turned = arrays["K"], again["K"]
    if frame == "sensor":
        u = turned[:27].reshape(3, 9, -1)
        turned = np.concatenate([np.einsum("ij,jkl->ikl", turn.T, u).reshape(27, -1), turned[27:]])
    assert np.abs(turned - k).max(axis=1) == pytest.approx(0.0, abs=1e-9 * np.abs(k).max())
    assert np.allclose(again["F"], arrays["F"] @ turn.T, atol=1e-18)
    assert np.allclose(again["M"], arrays["M"] @ turn.T + np.cross(shift, again["F"]), atol=1e-18)


# --- Beside what is known ---------------------------------------------------------------------------------------------


class BallSeries:
    """A layer bonded to a rigid ball under a point force (Love 1927, article 172), as vectors: no tables, no frames. mu = R = 1."""

    def __init__(self, nu: float, core: float, place: float) -> None:
        self.degrees = int(40.0 / (1.0 - place))
        self.place = place
        self.rows = [self.motion(n, nu, core, place) for n in range(self.degrees)]

    @staticmethod
    def motion(n: int, nu: float, core: float, place: float) -> tuple[float, ...]:
        """U, V, radial and tangential stress at `place` under a unit radial and a unit tangential traction; W and its stress."""

        def basis(r: float) -> Floats:
            columns = []
            for m, at in ((n, 1.0), (-n - 1, core)):  # powers of r / at overflow nowhere
                d, big = m + 5 - 4 * nu, -2 * (2 * nu * m + (3 * m + 1) * (1 - 2 * nu))
                low, high = (r / at) ** (m - 1), (r / at) ** (m + 1)
                columns.append([m * low, low, 2 * m * (m - 1) * low / r, (m - 1) * low / r - low / r + m * low / r])
                u, v = (d * m + big) * high, d * high
                radial = 2 * (m + 1) * u / r - 2 * nu * (2 * m + 3) * (2 * m + 2) * high / r
                columns.append([u, v, radial, (m + 1) * v / r - v / r + u / r])
            return np.array(columns).T

        if n == 0:
            lame = 2 * nu / (1 - 2 * nu)

            def even(r: float) -> Floats:
                u, slope = np.array([r, 1 / r**2]), np.array([1.0, -2 / r**3])
                return np.array([u, (lame + 2) * slope + 2 * lame * u / r])

            c = np.linalg.solve([even(core)[0], even(1.0)[1]], [0.0, 1.0])
            u, radial = even(place) @ c
            return u, 0.0, radial, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        matrix = np.concatenate([basis(core)[:2], basis(1.0)[2:]])
        sizes = np.abs(matrix).max(axis=0)
        c = np.linalg.solve(matrix / sizes, np.eye(4)[:, 2:]) / sizes[:, None]
        at = basis(place) @ c

        def turned(r: float) -> Floats:
            w = np.array([r**n, (core / r) ** (n + 1)])
            return np.array([w, np.array([n - 1, -n - 2]) * w / r])

        t = turned(place) @ np.linalg.solve([turned(core)[0], turned(1.0)[1]], [0.0, 1.0])
        return (*at[:, 0], *at[:, 1], *t)

    def __call__(self, normal: Floats, load: Floats, force: Floats) -> tuple[Floats, Floats]:
        """Displacement and traction across the sphere of the taxels, (n, 3) each, at unit normals under forces at unit places."""
        c = np.einsum("ij,ij->i", normal, load)
        out = np.einsum("ij,ij->i", force, load)
        along = force - out[:, None] * load

        def tangent(vector: Floats) -> Floats:
            return vector - np.einsum("ij,ij->i", vector, normal)[:, None] * normal

        to_load, drag, turn = tangent(load), tangent(along), np.cross(along, load)
        spin = tangent(turn)
        reach, twist = np.einsum("ij,ij->i", along, normal), np.einsum("ij,ij->i", turn, normal)
        p, p1, p2 = (
            (np.ones_like(c), np.zeros_like(c)),
            (np.zeros_like(c), np.zeros_like(c)),
            (np.zeros_like(c), np.zeros_like(c)),
        )
        u, s = np.zeros_like(normal), np.zeros_like(normal)
        for n, (ur, vr, sr, tr, ut, vt, st, tt, w, tw) in enumerate(self.rows):
            f = (2 * n + 1) / (4 * np.pi)
            q = f / (n * (n + 1)) if n else 0.0
            even = q * (p2[0] * reach)[:, None] * to_load + q * p1[0][:, None] * drag  # q grad of P' (x.t)
            odd = np.cross(normal, q * (p2[0] * twist)[:, None] * to_load + q * p1[0][:, None] * spin)
            slope = f * (p1[0] * out)[:, None] * to_load
            u += (f * ur * p[0] * out + q * ut * p1[0] * reach)[:, None] * normal + vr * slope + vt * even + w * odd
            s += (f * sr * p[0] * out + q * st * p1[0] * reach)[:, None] * normal + tr * slope + tt * even + tw * odd
            p, p1, p2 = (
                (
                    ((2 * n + 1) * c * now - (n + k) * before) / (n + 1 - k)
                    if n >= k
                    else np.full_like(c, (1.0, 1.0, 3.0)[k] * (n + 1 == k)),
                    now,
                )
                for k, (now, before) in enumerate((p, p1, p2))
            )
        return u, s


def exact_on_ball(asked: Any, arrays: dict[str, Any], block: Floats, load: int) -> Floats:
    """The readings under a unit traction, 0 normal, 1 or 2 along e_y or e_z, on some cells."""
    mu = asked.modulus / 2.0 / (1.0 + asked.poisson)
    depth = asked.taxels.depth[0]
    series = BallSeries(asked.poisson, 1.0 - asked.thickness / R, 1.0 - depth / R)
    s, w = np.polynomial.legendre.leggauss(3)
    points, areas = [], []
    for corners in arrays["vertices"][arrays["cells"][block]]:
        angles = np.arctan2(corners[:, [1, 0]], corners[:, [2]])  # the lattice's
        a, b = (np.linspace(angles[0, k], angles[2, k], 2).mean() + np.ptp(angles[:, k]) / 2.0 * s for k in range(2))
        tan_a, tan_b = (np.tan(grid).ravel() for grid in np.meshgrid(a, b, indexing="ij"))
        direction = np.stack([tan_b, tan_a, np.ones_like(tan_a)], axis=1)
        size = np.linalg.norm(direction, axis=1)
        points.append(direction / size[:, None])
        areas.append(
            np.outer(w, w).ravel() * np.ptp(angles[:, 0]) * np.ptp(angles[:, 1]) / 4.0 * (1 + tan_a**2) * (1 + tan_b**2) / size**3
        )
    place, area = np.concatenate(points), np.concatenate(areas)
    reference = np.array([0.0, 1.0, 0.0])
    force = area[:, None] * tool.frames(place, reference, str)[:, load]
    normal = asked.taxels.normal
    taxel, point = (grid.ravel() for grid in np.indices((len(normal), len(place))))
    u, stress = series(normal[taxel], place[point], force[point])
    axes = tool.frames(normal, reference, str)
    u, stress = (values.reshape(len(normal), len(place), 3).sum(axis=1) for values in (u, stress))
    local = np.einsum("nij,nj->ni", axes, u) * R / mu  # the area is that of R = 1
    across = np.einsum("nij,nj->ni", axes, stress)  # n sigma; stress_x = -sigma_xx, shear_xy = -x sigma y
    known = {f"displacement_{letter}": local[:, k] for k, letter in enumerate("xyz")}
    known |= {name: across[:, k] for k, name in enumerate(("stress_x", "shear_xy", "shear_xz"))}
    return np.array([known[quantity][i] for i, quantity in asked.taxels.readings()])


def errors_on_ball(elements: tuple[int, int, int], reads: list[str], depth: float, **given: Any) -> Floats:
    """The 2-norm of the readings' error over their own, of each traction on a square of 0.27 thickness around."""
    taxels = taxels_on_ball(np.linspace(-0.2, 0.2, 5), depth, reads)
    asked = request(taxels, **{"cells": (10, 10), "elements": elements, "margin": 0.0, "edge": 12e-3} | given)
    arrays = tool.make_kernel(asked)
    block = np.ravel_multi_index([grid.ravel() for grid in np.indices((4, 4)) + 3], (10, 10))
    errors = []
    for load in range(3):
        found = arrays["K"].reshape(-1, 3, 100)[:, load, block].sum(axis=1)
        exact = exact_on_ball(asked, arrays, block, load)
        errors.append(np.linalg.norm(found - exact) / np.linalg.norm(exact))
    return np.array(errors)


def test_displacements_converge_to_the_exact_ball_without_locking() -> None:
    coarse = errors_on_ball((8, 8, 2), OF, 1.6e-3)
    fine = errors_on_ball((12, 12, 3), OF, 1.6e-3)
    assert (fine < 0.032).all() and (coarse < 0.12).all()
    assert (fine < 0.6 * coarse).all()
    assert (errors_on_ball((12, 12, 3), OF, 1.6e-3, poisson=0.4999) < 0.035).all()
    assert (errors_on_ball((12, 12, 3), OF, 1.6e-3, poisson=0.0) < 0.032).all()


def test_stresses_are_those_of_the_exact_ball() -> None:
    reads = ["stress_x", "shear_xy", "shear_xz"]
    coarse, fine = errors_on_ball((12, 12, 3), reads, 1.6e-3), errors_on_ball((18, 18, 4), reads, 1.6e-3)
    assert (coarse < 0.09).all() and (fine < 0.04).all() and fine.max() < 0.6 * coarse.max()


def test_a_flat_pad_has_the_flat_kernel(tmp_path: Path) -> None:
    square = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]]) * 0.05
    mesh = write_obj(tmp_path / "flat.obj", square, [[0, 1, 2, 3]])
    for reads, depth, most in ((OF[:2], 1.6e-3, 0.03), (["stress_x", "shear_xy"], 2e-3, 0.09)):
        skin = tn.Scene.from_dict(
            {
                "sensor": {"rows": 5, "columns": 5, "pitch": [1.5e-3, 1.5e-3], "depth": depth, "reads": reads},
                "material": {"youngs_modulus": 0.25e6, "poisson_ratio": 0.48, "layer": {"thickness": H, "base": "bonded"}},
                "reconstruct": {"spacing": 0.5e-3, "margin": 0.5e-3},
            }
        )
        assert isinstance(skin, tn.Skin) and skin.traction_shape == (15, 15)
        places = skin.taxels  # y and z; the sensor's y is e_y, and its x is e_z
        place = np.stack([places[:, 1], places[:, 0], np.full(25, -depth)], axis=1)
        normal = np.tile([0.0, 0.0, 1.0], (25, 1))
        taxels = tool.Taxels([str(i) for i in range(25)], place, normal, np.full(25, depth), [list(reads)] * 25)
        asked = request(
            taxels,
            surface=lambda taxels, axes: tool.Mesh(mesh, 1.0, taxels, axes),
            cells=(15, 15),
            elements=(12, 12, 3),
            margin=0.75e-3,
            edge=14e-3,
        )
        found = tool.make_kernel(asked)
        assert np.allclose(found["F"], found["frames"] * 0.25e-6, atol=1e-16)
        block = np.ravel_multi_index([grid.ravel() for grid in np.indices((8, 8)) + 3], (15, 15))
        for load in range(3):
            ours = found["K"].reshape(50, 3, 225)[:, load, block].sum(axis=1)
            flat = skin.kernel_matrix().reshape(50, 3, 225)[:, load, block].sum(axis=1)
            assert np.linalg.norm(ours - flat) < most * np.linalg.norm(flat), (reads, load)


def test_a_mesh_of_a_ball_is_the_ball(tmp_path: Path) -> None:
    taxels = taxels_on_ball(np.linspace(-0.1, 0.1, 3), 1.6e-3, OF)
    angles = np.linspace(-0.45, 0.45, 25)
    mesh = write_obj(tmp_path / "ball.obj", *grid_of(angles, angles, on_ball))
    exact = tool.make_kernel(small(taxels=taxels))
    bent = tool.make_kernel(small(taxels=taxels, surface=lambda taxels, axes: tool.Mesh(mesh, 1.0, taxels, axes)))
    assert np.linalg.norm(bent["vertices"], axis=1) == pytest.approx(R, abs=1e-6)  # flat facets are 5e-6 inside
    assert np.linalg.norm(bent["K"] - exact["K"]) < 0.01 * np.linalg.norm(exact["K"])


def test_a_cylinder_and_a_hole_are_spanned_too(tmp_path: Path) -> None:
    def on_cylinder(angle: Floats, length: Floats) -> Floats:
        return np.stack([8e-3 * np.sin(angle), length, 8e-3 * np.cos(angle)], axis=1)

    mesh = write_obj(tmp_path / "finger.obj", *grid_of(np.linspace(-1.4, 1.4, 41), np.linspace(-0.03, 0.03, 9), on_cylinder))
    angle, length = (grid.ravel() for grid in np.meshgrid(np.linspace(-0.6, 0.6, 3), np.linspace(-8e-3, 8e-3, 3)))
    normal = np.stack([np.sin(angle), np.zeros(9), np.cos(angle)], axis=1)
    depth = 1e-3
    taxels = tool.Taxels(
        [str(i) for i in range(9)], on_cylinder(angle, length) - depth * normal, normal, np.full(9, depth), [OF] * 9
    )
    asked = small(
        taxels=taxels, thickness=3e-3, surface=lambda taxels, axes: tool.Mesh(mesh, 1.0, taxels, axes), edge=5e-3, margin=1e-3
    )
    arrays = tool.make_kernel(asked)
    place = arrays["vertices"]
    assert np.hypot(place[:, 0], place[:, 2]) == pytest.approx(8e-3, abs=2e-6)
    assert np.ptp(place[:, 1]) == pytest.approx(18e-3) and np.ptp(np.arctan2(place[:, 0], place[:, 2])) == pytest.approx(
        1.2 + 2.0 / 8.0, rel=2e-3
    )
    inward = taxels_on_ball(np.linspace(-0.1, 0.1, 3), 1.6e-3, [*OF])
    inward.place *= (R + 1.6e-3) / (R - 1.6e-3)
    inward.normal *= -1.0
    hole = tool.make_kernel(small(taxels=inward, surface=lambda taxels, axes: tool.Sphere(*tool.Sphere.fitted(taxels, H), axes)))
    assert np.linalg.norm(hole["vertices"], axis=1) == pytest.approx(R, abs=1e-6)
    assert (np.einsum("ij,ij->i", hole["frames"][:, 0], hole["vertices"][hole["cells"]].mean(axis=1)) > 0.9 * R).all()
    middle = hole["K"].reshape(3, 9, 3, 6, 6)[0, 4, 0]
    assert middle[2:4, 2:4].min() > 0.5 * middle.max() > 0.0  # a press moves the pad into the wall


def test_a_mean_over_a_taxel_is_the_mean_of_points() -> None:
    reads = ["displacement_x", "stress_x"]
    one = taxels_on_ball(np.zeros(1), 1.6e-3, reads)
    asked = small(taxels=one, margin=4e-3, width=1e-3)
    mean = tool.make_kernel(asked)["K"]
    s, w = np.polynomial.legendre.leggauss(4)
    y, z = (grid.ravel() * 0.5e-3 for grid in np.meshgrid(s, s, indexing="ij"))
    place = one.place + np.stack([z, y, np.zeros(16)], axis=1)  # e_z is the sensor's x here
    many = tool.Taxels([str(i) for i in range(16)], place, np.tile(one.normal, (16, 1)), np.full(16, 1.6e-3), [reads] * 16)
    pad, cells = tool.ranges(asked, ball()(one, tool.middle_frame(one, np.array([0.0, 1.0, 0.0]))))
    places, _ = tool.places_of(
        dataclasses.replace(asked, taxels=many, width=0.0),
        pad,
        np.tile(tool.frames(one.normal, cells.reference, str), (16, 1, 1)),
    )
    a = pad.stiffness()
    solve = tool.factor(a, "superlu")[1]
    free = pad.unknown >= 0
    for row, quantity in enumerate(reads):
        right = np.zeros(len(free))
        for at, share in zip(places[:, 0], np.outer(w, w).ravel() / 4.0, strict=True):
            degrees, values = pad.reading(at, quantity, tool.frames(one.normal, cells.reference, str)[0])
            np.add.at(right, degrees, share * values)
        expected = cells.loads()[0][:, free] @ solve(right[free])
        assert mean[row] == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


# --- The command ------------------------------------------------------------------------------------------------------


def cap_command(output: Path) -> list[str]:
    pad = ["--sphere", "--length-unit", "mm", "--thickness", "4", "--youngs-modulus", "0.25e6", "--poisson-ratio", "0.48"]
    lattice = ["--cells", "18x18", "--elements", "18x18x3", "--edge", "14"]
    return [str(CAP / "cap-taxels.csv"), *pad, "--reads", " ".join(OF), "--frame", "sensor", *lattice, "-o", str(output)]


def test_the_recorded_cap_is_solved_by_a_kernel_from_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert tool.main(cap_command(tmp_path / "k.npz")) == 0
    assert "24,642 unknowns" in capsys.readouterr().err
    with np.load(tmp_path / "k.npz", allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    assert arrays["K"].shape == (300, 972) and arrays["cells"].shape == (324, 4) and arrays["vertices"].shape == (361, 3)
    assert list(arrays["shape"]) == [18, 18] and str(arrays["frame"]) == "sensor" and set(arrays["units"]) == {"m"}
    assert all(array.dtype.kind in "fiU" and array.flags.c_contiguous for array in arrays.values())
    with (CAP / "cap-taxels.csv").open() as taxels:
        names = [row["name"] for row in csv.DictReader(taxels)]
    assert list(arrays["readings"]) == [f"{quantity}_{name}" for quantity in OF for name in names]
    with (CAP / "cap-clean.csv").open() as recorded:
        frames = list(csv.DictReader(recorded))
    truth = json.loads((CAP / "cap.truth.json").read_text())["frames"]
    left, size, right = np.linalg.svd(arrays["K"], full_matrices=False)
    alpha = 1e-3 * size[0]
    for frame, true in list(zip(frames, truth, strict=True))[1:7]:
        readings = np.array([1e-3 * float(frame[name]) for name in arrays["readings"]])
        tractions = (right.T @ (size / (size**2 + alpha**2) * (left.T @ readings))).reshape(3, -1)
        force = np.einsum("tk,kti->i", tractions, arrays["F"])
        moment = np.einsum("tk,kti->i", tractions, arrays["M"])
        assert np.linalg.norm(force - true["force"]) < 0.02 * np.linalg.norm(true["force"])
        assert np.linalg.norm(moment - true["moment"]) < 0.01 * R * np.linalg.norm(true["force"])


@pytest.mark.parametrize("solver", ["pardiso", "cholmod"])
def test_other_solvers_say_the_same(solver: str) -> None:
    pytest.importorskip({"pardiso": "pypardiso", "cholmod": "sksparse"}[solver])
    k = tool.make_kernel(small(solver="superlu"))["K"]
    assert np.abs(tool.make_kernel(small(solver=solver))["K"] - k).max() < 1e-10 * np.abs(k).max()


GOOD = """name,x,y,z,nx,ny,nz,depth,reads
a,0,0,28.4,0,0,1,1.6,displacement_x stress_x
b,2.83010,0,28.2586,0.0996512,0,0.995022,1.6,stress_x
c,0,2.83010,28.2586,0,0.0996512,0.995022,1.6,stress_x
"""


def run(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, *options: str) -> tuple[int, str]:
    (tmp_path / "t.csv").write_text(text)
    given = [
        "--length-unit",
        "mm",
        "--thickness",
        "4",
        "--youngs-modulus",
        "0.25e6",
        "--poisson-ratio",
        "0.48",
        "--frame",
        "local",
    ]
    shape = [] if any(option.startswith(("--sphere", "--surface")) for option in options) else ["--sphere=0,0,0,30"]
    lattice = ["--elements", "4x4x1", "--cells", "2x2", "-q", "-o", str(tmp_path / "k.npz")]
    status = tool.main([str(tmp_path / "t.csv"), *given, *shape, *lattice, *options])
    return status, capsys.readouterr().err


def test_units_in_headers_and_names_of_readings(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, capsys, "# made by hand\n" + GOOD.replace("x,y,z,nx", "x [mm],y [mm],z [mm],nx"), "--sphere") == (0, "")
    with np.load(tmp_path / "k.npz") as file:
        assert list(file["readings"]) == ["displacement_x_a", "stress_x_a", "stress_x_b", "stress_x_c"]
        assert list(file["units"]) == ["m", "Pa", "Pa", "Pa"]
    assert [path.name for path in tmp_path.iterdir() if path.suffix == ".part"] == []


@pytest.mark.parametrize(
    ("change", "options", "words"),
    [
        (("x,y,z,nx", "x [cm],y,z,nx"), (), "another unit than mm: give --length-unit cm"),
        (("nz,depth", "nz,deep"), (), "there is a column 'deep'"),
        (("nx,ny,nz,depth", "nx,nx,nz,depth"), (), "two columns 'nx'"),
        (("name,x,y,z,nx,ny,nz,depth,reads", "name,x,y,z"), (), "no column nx"),
        (("28.4,0", "nan,0"), (), "z is 'nan', which is no finite number"),
        (("0,0,1,1.6", "0,0,1.01,1.6"), (), "1.01 long: it must be of unit length"),
        (("0,0,1,1.6", "0,0,-1,1.6"), (), "the normal of taxel a points into the pad"),
        (("0,0,1,1.6", "0,0.6,0.8,1.6"), (), "37 degrees off the surface's"),
        (("0,0,1,1.6", "0,0,1,1.1"), (), "lies 0.0016 m below the surface, and its depth is said to be 0.0011"),
        (("0,0,1,1.6", "0,0,1,4.1"), (), "it would lie in the core"),
        (("0,0,1,1.6", "0,0,1,0"), (), "depth is 0"),
        (("b,2.83010,0,28.2586", "a,2.83010,0,28.2586"), (), "two taxels are called a"),
        (("b,2.83010,0,28.2586,0.0996512,0,0.995022", "b,0,0,28.4,0,0,1"), (), "taxels a and b are at one place and both read stress_x"),
        (("displacement_x stress_x", "displacement_x stres_x"), (), "reads 'stres_x': it may read stress_x"),
        (("", ""), ("--length-unit", "m"), "give --length-unit"),
        (("", ""), ("--thickness", "0.001"), "--length-unit says what lengths are in"),
        (("", ""), ("--thickness", "31", "--edge", "8", "--margin", "2"), "least radius of curvature"),
        (("", ""), ("--poisson-ratio", "0.5"), "give 0.4999 for rubber"),
        (("", ""), ("--youngs-modulus", "0"), "Young's modulus is 0 Pa"),
        (("", ""), ("--margin", "9", "--edge", "8"), "make --margin less"),
        (("", ""), ("--edge", "60"), "more than 150 degrees of its surface, where the lattice's rays miss it: --edge may be 0.03"),
        (("", ""), ("--elements", "200x200x4"), "give fewer --elements"),
        (("", ""), ("--reference", "0,0,1"), "within 10 degrees of the normal"),
        (("", ""), ("--reference", "0,0,0"), "must be a direction"),
        (("", ""), ("--sphere=0,0,0"), "it takes centre and radius"),
        (("", ""), ("--surface", "nothing.obj"), "No such file"),
        (("c,0,2.83010,28.2586,0", "c,0,6.83010,28.2586,0"), ("--sphere",), "the taxels lie on no sphere"),
        ((GOOD[GOOD.index("b,") :], ""), ("--sphere",), "they determine no sphere"),
        (("0.0996512,0,0.995022,1.6", "-0.01,0,0.99995,1.6"), ("--sphere",), "do not determine the sphere"),
        (("", ""), ("--width", "40"), "taxel a lies outside of the pad, with half of --width"),
        (("", ""), ("-o", "nowhere/k.npz"), "there is no folder nowhere"),
        ((GOOD, ""), (), "it is empty"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_in_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], change: tuple[str, str], options: tuple[str, ...] | str, words: str
) -> None:
    text = GOOD.replace(*change)
    assert text != GOOD or change == ("", "")
    status, said = run(tmp_path, capsys, text, *((options,) if isinstance(options, str) else options))
    assert status == 1 and words in said and said.startswith("error: ") and said.count("\n") == 1
    assert not (tmp_path / "k.npz").exists()


def test_the_frame_of_displacements_must_be_said() -> None:
    with pytest.raises(tool.Refusal, match="--frame sensor"):
        tool.make_kernel(small(frame=None))


def test_bad_meshes_are_refused_with_the_triangle(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    angles = np.linspace(-0.9, 0.9, 13)
    vertices, faces = grid_of(angles, angles, lambda a, b: 1e3 * on_ball(a, b))
    whole = [[face[0], *face[k : k + 2]] for face in faces for k in (1, 2)]
    beyond = len(vertices)
    cases: list[tuple[Floats, list[list[int]], str]] = [
        (vertices, [face[::-1] for face in whole], "the mesh is turned inside out"),
        (vertices, [*whole[:100], whole[100][::-1], *whole[101:]], "is turned inside out against triangle"),
        (vertices, whole[:140] + whole[156:], "the mesh is open at"),
        (vertices, [*whole, [whole[140][0], whole[140][1], beyond - 1]], "has an edge that two other triangles share"),
        (np.concatenate([vertices, 1.1 * vertices]), whole + [[i + beyond for i in face] for face in whole], "lies over itself"),
        (vertices, [*whole, [0, 1, beyond + 3]], f"names vertex {beyond + 4} of {beyond}"),
        (1e3 * vertices, whole, "give --length-unit"),
        (vertices, [], "it holds no face"),
    ]
    mesh = tmp_path / "m.obj"
    options = ["--surface", str(mesh)]
    write_obj(mesh, vertices, whole)
    assert run(tmp_path, capsys, GOOD, *options) == (0, "")
    (tmp_path / "k.npz").unlink()
    for points, triangles, words in cases:
        write_obj(mesh, points, triangles)
        status, said = run(tmp_path, capsys, GOOD, *options)
        assert status == 1 and words in said and said.count("\n") == 1, said
    mesh.write_text("v 1 2\nf 1 2 3\n")
    assert "m.obj:1: 'v 1 2' is no vertex" in run(tmp_path, capsys, GOOD, *options)[1]
    assert not (tmp_path / "k.npz").exists()

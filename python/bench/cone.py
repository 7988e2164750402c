"""Frames with constraints by a plan, beside solvers of general convex problems: DAQP (lines) and Clarabel (skins).

Both are fetched by hand (`pip install daqp clarabel scipy`) and set up once; a plan's steps start anew in each frame.
Prints the difference in P's norm over what both say they are off, at most 1, and the ratio of times.

`cone.py --picture docs/control/steps.svg` needs neither: it draws how far frames are from their minimum after so many
steps, and the bound that each says of itself.
"""

from __future__ import annotations

import math
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import tactile_net as tn

FRICTION = 0.8
FRAMES = 60


def line(count: int) -> dict[str, Any]:
    sensor = {"count": count, "pitch": 20e-3 / 1.5 / (count - 1), "depths": [1e-3], "reads": ["stress_x", "shear_xy"]}
    return {"sensor": sensor, "material": {"youngs_modulus": 0.2e6, "poisson_ratio": 0.5}}


def skin(size: int) -> dict[str, Any]:
    sensor = {"rows": size, "columns": size, "pitch": 2e-3, "depths": [4e-3], "reads": ["stress_x", "shear_xy", "shear_xz"]}
    return {"sensor": sensor, "material": {"youngs_modulus": 0.2e6, "poisson_ratio": 0.5}}


def contacts(cells: np.ndarray, components: int, random: np.random.Generator, radius: float) -> np.ndarray:
    """Tractions of one to three Hertz contacts, dragged up to slip."""
    f = np.zeros((components, len(cells)))
    for _ in range(random.integers(1, 4)):
        at = cells[random.integers(len(cells))]
        inside = 1.0 - (((cells - at) / (radius * random.uniform(0.75, 2.0))) ** 2).sum(axis=1)
        p = random.uniform(0.3, 1.0) * np.sqrt(np.maximum(inside, 0.0))
        drag, angle = FRICTION * min(1.0, random.uniform() / 0.7), random.uniform(0.0, 2.0 * np.pi)
        f[0] += p
        f[1] += drag * np.cos(angle) * p
        if components == 3:
            f[2] += drag * np.sin(angle) * p
    return f.ravel()


def by_daqp(P: np.ndarray, n: int) -> Any:
    import daqp

    eye = np.eye(n)
    # p >= 0; mu p - q >= 0; mu p + q >= 0.
    A = np.block([[FRICTION * eye, -eye], [FRICTION * eye, eye]])
    bounds = np.concatenate([np.full(n, 1e30), np.full(2 * n, 1e30)]), np.zeros(2 * n)

    def solve(b: np.ndarray) -> np.ndarray:
        upper = np.full(2 * n, 1e30)
        x, _, flag, _ = daqp.solve(P, -b, A, upper, bounds[1], np.zeros(2 * n, dtype=np.int32))
        assert flag > 0
        return np.asarray(x)

    return solve


def by_clarabel(P: np.ndarray, n: int) -> Any:
    import clarabel
    from scipy import sparse

    rows = []
    for i in range(n):  # (mu p, q_y, q_z) in a second-order cone
        block = np.zeros((3, 3 * n))
        block[0, i], block[1, n + i], block[2, 2 * n + i] = -FRICTION, -1.0, -1.0
        rows.append(sparse.csc_matrix(block))
    A = sparse.vstack(rows, format="csc")
    cones = [clarabel.SecondOrderConeT(3)] * n
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_rel = settings.tol_gap_abs = settings.tol_feas = 1e-10
    upper = sparse.triu(sparse.csc_matrix(P), format="csc")

    def solve(b: np.ndarray) -> np.ndarray:
        return np.asarray(clarabel.DefaultSolver(upper, -b, A, np.zeros(3 * n), cones, settings).solve().x)

    return solve


def compare(name: str, scene: tn.Scene, alpha: float, steps: int, rival: Any, radius: float) -> None:
    random = np.random.default_rng(1)
    components = 3 if len(scene.reading_shape) == 3 else 2
    bare = scene.kernel_matrix()
    alpha *= np.linalg.norm(bare, 2) ** 2
    P = scene.normal_matrix(alpha)
    noise = 1.0
    plan = scene.replace({"noise": {"rms": noise}, "reconstruct.alpha": alpha}).plan(
        friction_limit=FRICTION, steps=steps, diagnostics=False, accuracy=1e-10
    )
    estimator = tn.Estimator(plan)
    y, z = plan.y, plan.z if len(plan.z) else np.zeros(1)
    cells = np.stack(np.meshgrid(y, z, indexing="ij"), axis=-1).reshape(-1, 2)
    solve = rival(P, len(cells))
    worst, ours, theirs = 0.0, [], []
    for _ in range(FRAMES):
        readings = bare @ contacts(cells, components, random, radius)
        readings *= 100.0 * noise / np.abs(readings).max()
        readings += noise * random.standard_normal(len(readings))
        frame = np.ascontiguousarray(readings)
        start = time.perf_counter()
        f = estimator.update(frame).ravel()
        ours.append(time.perf_counter() - start)
        b = bare.T @ readings
        start = time.perf_counter()
        best = solve(b)
        theirs.append(time.perf_counter() - start)
        off = np.sqrt(max((f - best) @ P @ (f - best), 0.0))
        own = 1e-4 * np.sqrt(best @ P @ best)  # what a general solver's tolerance leaves
        worst = max(worst, off / (noise * estimator.contact.unfinished + own))
    print(
        f"{name}, {steps} steps: {1e6 * min(ours):.0f} us, {rival.__name__[3:]} {1e6 * np.median(theirs):.0f} us: "
        f"{np.median(theirs) / np.median(ours):.0f} times; difference over both bounds at most {worst:.2f}"
    )
    assert worst <= 1.0


def course(size: int, alpha: float) -> tuple[list[int], list[float], list[float]]:
    """Steps, and after them the median of a hundred frames' true distances and bounds, in standard deviations."""
    random = np.random.default_rng(2)
    scene = tn.Scene.from_dict(skin(size))
    bare = scene.kernel_matrix()
    alpha *= np.linalg.norm(bare, 2) ** 2
    noisy = scene.replace({"noise": {"rms": 1.0}, "reconstruct.alpha": alpha})
    estimator = tn.Estimator(noisy.plan(friction_limit=FRICTION, steps=64, diagnostics=False))
    P = scene.normal_matrix(alpha)
    y, z = estimator.plan.y, estimator.plan.z
    cells = np.stack(np.meshgrid(y, z, indexing="ij"), axis=-1).reshape(-1, 2)
    steps = list(range(1, 41))
    off, bound = np.zeros((100, len(steps))), np.zeros((100, len(steps)))
    for frame in range(100):
        readings = bare @ contacts(cells, 3, random, 4e-3)
        readings *= 100.0 / np.abs(readings).max()
        readings += random.standard_normal(len(readings))
        estimator.set_work(steps=64)
        best = estimator.update(readings).ravel().copy()
        for k, count in enumerate(steps):
            estimator.set_work(steps=count)
            left = estimator.update(readings).ravel() - best
            off[frame, k] = math.sqrt(max(left @ P @ left, 0.0))
            bound[frame, k] = estimator.contact.unfinished
    return steps, list(np.median(off, axis=0)), list(np.median(bound, axis=0))


def picture(file: Path) -> None:
    width, height, left, bottom, top = 720, 360, 70, 310, 20
    low, high = -3.0, 2.0

    def at(step: float, value: float) -> str:
        x = left + (width - left - 20) * step / 40
        y = bottom - (bottom - top) * (min(max(math.log10(max(value, 1e-9)), low), high) - low) / (high - low)
        return f"{x:.1f},{y:.1f}"

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">']
    parts.append(f'<rect width="{width}" height="{height}" fill="white"/>')
    for decade in range(int(low), int(high) + 1):
        x, y = at(0, 10.0**decade).split(",")
        parts.append(
            f'<path d="M{x},{y}H{width - 20}" stroke="#ddd"/><text x="{left - 8}" y="{float(y) + 4}" text-anchor="end">{10.0**decade:g}</text>'
        )
    for step in range(0, 41, 8):
        x = at(step, 1.0).split(",")[0]
        parts.append(f'<text x="{x}" y="{bottom + 18}" text-anchor="middle">{step}</text>')
    parts.append(f'<text x="{(left + width) / 2}" y="{height - 8}" text-anchor="middle">steps</text>')
    parts.append(
        f'<text transform="translate(16,{(top + bottom) / 2}) rotate(-90)" text-anchor="middle">standard deviations</text>'
    )
    cases = [
        ("8 x 8 x 3, alpha 1e-3", 8, 1e-3, "#0072b2"),
        ("16 x 16 x 3, alpha 1e-3", 16, 1e-3, "#d55e00"),
        ("16 x 16 x 3, alpha 1e-4", 16, 1e-4, "#009e73"),
    ]
    for row, (label, size, alpha, colour) in enumerate(cases):
        steps, off, bound = course(size, alpha)
        for values, dash in ((bound, ""), (off, ' stroke-dasharray="5 4"')):
            points = " ".join(at(step, value) for step, value in zip(steps, values, strict=True) if value > 10.0**low)
            parts.append(f'<polyline fill="none" stroke="{colour}" stroke-width="1.8"{dash} points="{points}"/>')
        y = top + 14 + 18 * row
        parts.append(
            f'<path d="M450,{y - 4}h26" stroke="{colour}" stroke-width="1.8"/><text x="482" y="{y}">{label}: the bound</text>'
        )
    parts.append(
        f'<path d="M450,{top + 64}h26" stroke="#444" stroke-width="1.8" stroke-dasharray="5 4"/><text x="482" y="{top + 68}">the true distance</text></svg>'
    )
    file.write_text("\n".join(parts) + "\n", encoding="utf-8")


def main() -> None:
    if sys.argv[1:2] == ["--picture"]:
        return picture(Path(sys.argv[2]))
    for count in (41, 81):
        compare(f"line {count}", tn.Scene.from_dict(line(count)), 1e-4, 24, by_daqp, 1e-3)
    compare("skin 8 x 8", tn.Scene.from_dict(skin(8)), 1e-3, 24, by_clarabel, 4e-3)


if __name__ == "__main__":
    main()

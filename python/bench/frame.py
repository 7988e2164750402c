"""What a frame's call costs from Python, beside NumPy's products: tools/python bench.

A batch of a line is the C++ call in a loop; what `step` and `update` take beyond it is Python's price, in `update` a lambda's included.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

import tactile_net as tn


def nanoseconds(call: Callable[[], object], frames: int = 1) -> float:
    """The least of many short batches, a frame."""
    call()  # the first one finds out how NumPy's arrays are made: as long as a batch, which would then be a single call
    repeats = 1
    while _seconds(call, repeats) < 1e-4:
        repeats *= 2
    return min(_seconds(call, repeats) for _ in range(2000)) / repeats / frames * 1e9


def _seconds(call: Callable[[], object], repeats: int) -> float:
    begin = time.perf_counter()
    for _ in range(repeats):
        call()
    return time.perf_counter() - begin


def importing(what: str) -> float:
    """Milliseconds, the least of some."""
    script = f"import time, numpy; begin = time.perf_counter(); import {what}; print(time.perf_counter() - begin)"
    runs = [
        subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True) for _ in range(15)
    ]
    return 1e3 * min(float(run.stdout) for run in runs)


scene = tn.Scene(
    sensor=tn.Sensor(count=81, pitch=0.25e-3, depth=1.5e-3, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(force=1.0, half_width=2e-3)],
    reconstruct=tn.Reconstruct(alpha=1e-4),
)
frame = np.ascontiguousarray(scene.simulate().readings[0])
frames = np.repeat(frame[None], 1000, axis=0)
matrix = np.ascontiguousarray(scene.solver()(np.eye(81)).reshape(81, 81).T)
out, flat, many = np.empty((1, 81)), np.empty(81), np.ascontiguousarray(frames.reshape(1000, 81))

for diagnostics in (False, True):
    estimator = tn.Estimator(scene.plan(diagnostics=diagnostics))
    estimator.readings[:] = frame
    batch = nanoseconds(lambda: estimator.update_batch(frames), 1000)
    step = nanoseconds(estimator.step)
    update = nanoseconds(lambda: estimator.update(frame, out))
    print(f"diagnostics {diagnostics}: update_batch {batch:.0f} ns a frame, step {step:.0f}, update {update:.0f}")
print(f"an empty Python function: {nanoseconds(lambda: None):.0f} ns")
dot = nanoseconds(lambda: np.dot(matrix, flat, out=out[0]))
product = nanoseconds(lambda: many @ matrix.T, 1000)
print(f"numpy.dot(M, g, out=f): {dot:.0f} ns; G @ M.T of 1000: {product:.0f} ns a frame")
print(f"import: {importing('tactile_net'):.1f} ms beside NumPy")

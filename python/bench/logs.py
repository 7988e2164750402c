"""What recordings cost on disk: frames per second through MCAP, milliseconds through the containers: tools/python bench.

The floor of a log is 5000 frames/s each way.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import tactile_net as tn


def seconds(call: Callable[[], Any]) -> float:
    """The least of some."""
    runs = []
    for _ in range(3):
        begin = time.perf_counter()
        call()
        runs.append(time.perf_counter() - begin)
    return min(runs)


def size(path: str) -> int:
    """Of a file, or of all in a folder."""
    if os.path.isfile(path):
        return os.path.getsize(path)
    return sum(os.path.getsize(os.path.join(at, one)) for at, _, files in os.walk(path) for one in files)


scene = tn.Scene(
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x", "shear_xy"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    units={},
)
frames = 5000
readings = np.random.default_rng(1).normal(size=(frames, 2, 41))
recording = tn.Recording(scene, readings, np.arange(frames) * 1e-3)
with tempfile.TemporaryDirectory() as folder:
    print(f"{frames} frames of 2 x 41 readings, the least of 3")
    for suffix in (".mcap", ".npz", ".nc", ".zarr", ".parquet", ".csv", ".npy"):
        path = os.path.join(folder, f"pad{suffix}")
        given = {"scene": scene, "units": "scene"} if suffix == ".npy" else {}
        writing = seconds(lambda: recording.save(path))
        reading = seconds(lambda: tn.load(path, **given))
        assert np.array_equal(tn.load(path, **given).readings, readings)
        print(
            f"{suffix:9} write {1e3 * writing:6.0f} ms, {frames / writing:8.0f} frames/s; "
            f"read {1e3 * reading:6.0f} ms, {frames / reading:8.0f} frames/s; {size(path) / 1e6:.1f} MB"
        )

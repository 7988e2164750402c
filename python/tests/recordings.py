"""What tests of recordings on disk have alike: a small scene, its readings, and files of them."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import strategies as st

import tactile_net as tn

SENSOR: dict[str, Any] = {"count": 3, "pitch": 0.5, "depth": 1.5, "reads": ["stress_x", "strain_x"]}
SMALL = tn.Scene(
    sensor=SENSOR, material={"youngs_modulus": 200.0, "poisson_ratio": 0.45}, units={"length": "mm", "stress": "kPa"}
)
UNITLESS = SMALL.replace({"units": None})
DEAD = SMALL.replace({"dead_taxels": {"indices": [1]}})
FLOATS = st.floats(width=64).map(lambda x: np.nan if np.isnan(x) else x)


def bits(array: Any) -> Any:
    return None if array is None else (array.dtype, array.shape, array.tobytes())


def assert_same(again: tn.Recording, recording: tn.Recording) -> None:
    for name in ("readings", "t", "truth"):
        assert bits(getattr(again, name)) == bits(getattr(recording, name)), name
    assert again.scene.text == recording.scene.text
    assert Path(again.scene.file).name == Path(recording.scene.file).name
    assert set(recording.notes) <= set(again.notes)  # what was found while reading comes after them


READINGS = np.arange(24.0).reshape(4, 2, 3)
SI = READINGS * np.array([1e3, 1.0])[:, None]
"""Of kPa and of strains."""


def npz(path: Path, **held: Any) -> None:
    with open(path, "wb") as file:
        np.savez(file, **held)


def npy(path: Path, array: Any, **how: Any) -> None:
    with open(path, "wb") as file:
        np.save(file, array, **how)


def npy_bytes(array: Any) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def saved(path: Path, suffix: str) -> bytes:
    """Of 50 frames."""
    recording = tn.Recording(SMALL, np.random.default_rng(1).normal(size=(50, 2, 3)), np.arange(50) * 0.01)
    recording.save(path.with_suffix(suffix))
    return path.with_suffix(suffix).read_bytes()



"""The tests of the Python package: of the installed wheel, never of the source tree, and without a network."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

import tactile_net as tn

PROJECT = Path(__file__).resolve().parents[2]
OTHERS = {"hands", "skins", "sweeps", "curved-pad"}  # folders without scenes of line arrays
SCENES = sorted(
    path
    for path in (PROJECT / "scenes").rglob("*.toml")
    if path.parent.name not in OTHERS and path.name != "hand.toml" and not path.name.startswith("skin-")
)
SKINS = sorted((PROJECT / "scenes/skins").glob("*.toml")) + sorted((PROJECT / "scenes/recorded").glob("skin-*.toml"))
SKINS += sorted((PROJECT / "scenes/recorded/curved-pad").glob("*.toml"))

settings.register_profile("suite", deadline=None, derandomize=True, max_examples=60)
settings.load_profile("suite")


# Scenes and a recording that take the longest; their smaller likes go the same way.
LONG = re.compile(r"\b(board|ladder|large|everything)\.toml|skin-pad-uneven")


# Of parts that a wheel may lack, with packages of their own.
PARTS = {
    "logs": re.compile(r"test_(skin_)?logs\.py|\[logs\.md\]|robot_log|\bmcap\b"),
    "mujoco": re.compile(r"test_mujoco|\[mujoco\.md\]|_mujoco_"),
    "sensors": re.compile(r"::\w+_(paxinis_(recorder|sdk)|tac3d|lerobot|isaac|flexitac|anyskin|biotac)\b"),
}


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if LONG.search(item.nodeid):
            item.add_marker(pytest.mark.long)
        for part, names in PARTS.items():
            if names.search(item.nodeid):
                item.add_marker(part)


def pytest_configure() -> None:
    assert Path(tn.__file__).is_relative_to(sys.prefix), f"these test an installed wheel, not {tn.__file__}"


@pytest.fixture(autouse=True, scope="session")
def no_network() -> None:
    connect = socket.socket.connect

    def local(self: socket.socket, address: Any) -> None:
        if self.family != socket.AF_UNIX and not str(address[0]).startswith("127."):
            raise OSError(f"a test reaches for the network: {address}")
        connect(self, address)

    socket.socket.connect = local  # type: ignore[method-assign]


@pytest.fixture(scope="session")
def command() -> Callable[..., str]:
    """Runs the command that was built of the same objects; returns what it prints."""
    program = os.environ["TACTILE_NET_COMMAND"]

    def run(*arguments: Any, status: int = 0) -> str:
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        assert done.returncode == status, done.stderr
        return done.stdout

    return run


@pytest.fixture(params=SCENES, ids=lambda path: str(path.relative_to(PROJECT / "scenes")))
def shipped(request: pytest.FixtureRequest) -> Path:
    """Every scene in scenes/."""
    path: Path = request.param
    return path


@pytest.fixture
def scene() -> tn.Scene:
    """A small one, quick to solve."""
    return tn.Scene(
        sensor=tn.Sensor(count=21, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        contacts=[tn.Cylinder(force=1.0, half_width=2e-3)],
        noise=tn.Noise(rms=1.0),
        reconstruct=tn.Reconstruct(alpha=1e-3),
    )


@pytest.fixture
def skin() -> tn.Skin:
    """A small one, quick to solve, with a given alpha."""
    return tn.Skin(
        sensor=tn.Sensor(
            rows=6, columns=5, pitch=[2e-3, 1.5e-3], depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]
        ),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=2.5e-3, place=[0.5e-3, -0.4e-3], friction=0.4, direction=30.0)],
        noise=tn.Noise(rms=10.0),
        reconstruct=tn.Reconstruct(alpha=1e-6),
        units={},
    )


@pytest.fixture
def two(scene: tn.Scene) -> tn.Scene:
    """Two channels, both tractions, time."""
    return scene.replace(
        {"sensor.reads": ["stress_x", "shear_xy"], "contact.0.friction": 0.3, "time": {"rate": 100.0, "frames": 5}}
    )


@pytest.fixture
def uneven() -> tn.Scene:
    return tn.Scene.load(PROJECT / "scenes/coarse/strip.toml")


@pytest.fixture
def frame(scene: tn.Scene) -> Any:
    return np.ascontiguousarray(scene.simulate().readings[0])

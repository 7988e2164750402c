"""A curved skin's calibrated scene, taken up again in Python: its surface, its forces, and what `check` says of a recording."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import tactile_net as tn

RNG_SEED = 8
RADIUS = 15e-3
NOISE = 60.0
SIDE = 6
SCENE = """
[units]
[sensor]
taxels = "dome.csv"
reads = ["stress_x", "shear_xy"]
[surface]
shape = "sphere"
radius = 0.015
[material]
youngs_modulus = 0.24e6
poisson_ratio = 0.46
layer = { thickness = 4e-3, base = "bonded" }
"""


def dome(depth: float) -> tn.Geometry:
    """Taxels over a dome around z."""
    y, z = np.meshgrid(*2 * [2e-3 * (np.arange(SIDE) - 0.5 * (SIDE - 1))], indexing="ij")
    angle = np.hypot(y, z).ravel() / RADIUS
    sideways = (np.sin(angle) / (RADIUS * angle))[:, np.newaxis] * np.stack([z.ravel(), y.ravel()], axis=1)
    normals = np.column_stack([sideways, np.cos(angle)])
    return tn.Geometry((RADIUS - depth) * normals, normals, depth=np.full(SIDE**2, depth))


class PressedDome:
    """One whose taxels lie 1.8 mm deep where its drawing says 1.5, with gains and offsets that nobody knows."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.random = np.random.default_rng(RNG_SEED)
        (folder / "dome.csv").write_text(dome(1.5e-3).text())
        self.nominal = folder / "nominal.toml"
        self.nominal.write_text(SCENE)
        (folder / "true").mkdir()
        (folder / "true/dome.csv").write_text(dome(1.8e-3).text())
        (folder / "true/dome.toml").write_text(SCENE)
        self.true = tn.Skin.load(folder / "true/dome.toml")
        self.names = self.true.reading_names
        self.gains = np.exp(0.05 * self.random.standard_normal(len(self.names)))
        self.offsets = 200.0 * self.random.standard_normal(len(self.names))

    def clean(self, y: float, z: float, force: float, radius: float) -> NDArray[np.float64]:
        contact: Any = {"shape": "sphere", "place": [y, z], "radius": radius, "force": force}
        return np.asarray(self.true.replace({"contact": [contact]}).simulate().readings.ravel())

    def said(self, clean: NDArray[np.float64] | float) -> NDArray[np.float64]:
        noise = NOISE * self.random.standard_normal(len(self.names))
        return np.asarray(self.gains * clean + self.offsets + noise)

    def log(self) -> Path:
        known = ["press", "shape", "force", "force_sd", "position_y", "position_z", "position_sd", "radius", "half_width", "half_width_sd"]
        lines = [",".join([*known, *self.names])]
        lines += [",".join(["0", "none", *8 * [""], *map(repr, self.said(0.0).tolist())]) for _ in range(24)]
        for p in range(14):
            y, z, force, radius = 1e-3 * (3 * (p // 4) - 4.5), 1e-3 * (3 * (p % 4) - 4.5), 0.4 + 0.05 * (p % 7), 1e-3 * (1.2 + 0.3 * (p % 4))
            stated = [force, 0.01 * force, y, z, 1e-4, "", radius, 0.02 * radius]
            body = self.said(self.clean(y, z, force, radius)).tolist()
            lines.append(",".join([str(p + 1), "sphere", *map(str, stated), *map(repr, body)]))
        path = self.folder / "log.csv"
        path.write_text("\n".join([*lines, ""]))
        return path

    def saved(self, name: str, frames: NDArray[np.float64]) -> Path:
        path = self.folder / name
        np.savetxt(path, frames, delimiter=",", header=",".join(self.names), comments="")
        return path


@pytest.fixture(scope="module")
def pressed(tmp_path_factory: pytest.TempPathFactory) -> PressedDome:
    return PressedDome(tmp_path_factory.mktemp("dome"))


def test_a_calibrated_dome_is_read_back(pressed: PressedDome) -> None:
    found = tn.calibrate(pressed.log(), pressed.nominal, next=2, target="depth")
    depth = found.parameters["depth"]
    assert depth.sd is not None and abs(depth.value - 1.8e-3) < 3.0 * depth.sd and depth.sd < 0.05e-3
    assert len(found.next) == 2 and found.next[1].unknown_then < found.next[0].unknown_then
    written = found.write(pressed.folder / "calibrated.toml", force=True)
    again = tn.Skin.load(pressed.folder / "calibrated.toml")
    nominal = tn.Skin.load(pressed.nominal)
    assert isinstance(written, tn.Skin) and again.text == written.text
    assert again.reading_names == pressed.names
    # The same surface and normals, the taxels deeper below it.
    for ours, theirs in ((again.normals, nominal.normals), (again.positions, nominal.positions)):
        assert ours is not None and theirs is not None and np.array_equal(ours, theirs)
    assert np.allclose(again.sites.depth, depth.value, atol=2e-3 * depth.sd) and np.allclose(nominal.sites.depth, 1.5e-3)
    # Presses that were not in the log, as the sensor says them.
    loads = [(1e-3, -0.5e-3, 0.5, 1.5e-3), (-2e-3, 2.2e-3, 0.4, 2e-3)]
    solution = again.read(pressed.saved("loads.csv", np.stack([pressed.said(pressed.clean(*one)) for one in loads]))).solve()
    for k, (_, _, force, _) in enumerate(loads):
        assert solution.normal_force[k] == pytest.approx(force, rel=0.06)
        assert abs(solution.normal_force[k] - force) < 3.0 * solution.normal_force_deviation[k]


def test_what_check_says_of_a_calibrated_dome(pressed: PressedDome) -> None:
    """Of a sound recording nothing but what it holds; a taxel that broke since the calibration is named."""
    if not (pressed.folder / "calibrated.toml").exists():
        tn.calibrate(pressed.log(), pressed.nominal).write(pressed.folder / "calibrated.toml")
    scene = tn.Skin.load(pressed.folder / "calibrated.toml")
    press = pressed.clean(1e-3, -0.5e-3, 0.5, 1.5e-3)
    share = np.concatenate([np.zeros(30), np.linspace(0.0, 1.0, 15), np.ones(25), np.linspace(1.0, 0.0, 15), np.zeros(15)])
    frames = np.stack([pressed.said(part * press) for part in share])
    sound = scene.read(pressed.saved("sound.csv", frames)).check()
    assert sound.findings == (), str(sound)
    # The scene of the drawing reads the same numbers, and they have a zero of their own.
    assert "baseline" in " ".join(one.kind for one in tn.Skin.load(pressed.nominal).read(pressed.folder / "sound.csv").check().findings)
    broken = frames.copy()
    lost = pressed.names.index("stress_x_" + scene.taxel_names[14])
    broken[:, lost] = pressed.offsets[lost]
    broken[:, lost + SIDE**2] = 0.0
    said = scene.read(pressed.saved("broken.csv", broken)).check()
    named = [one for one in said.findings if one.kind in ("dead_taxels", "stuck_taxels")]
    assert [one.numbers["taxels"] for one in named] == [[14]], str(said)
    assert scene.taxel_names[14] in named[0].advice

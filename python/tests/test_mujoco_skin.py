"""Skins in MuJoCo: they carry the contacts' force, drag and torque, to the right side, in the model's sensor too."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import tactile_net as tn

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install tactile-net[mujoco]")
from test_mujoco import BALL, BOX, at_rest, model, nothing_stays  # noqa: E402

__all__ = ["nothing_stays"]  # a fixture of every test

WEIGHT = 0.1 * 9.81
PITCH = 1.5e-3
TETRAHEDRON = '<geom type="mesh" mesh="foot" mass=".1"/>'
ASSET = '<asset><mesh name="foot" vertex="-.007 -.005 -.0095 .008 -.004 -.0095 0 .007 -.0095 0 0 .02"/></asset>'


def skin(**more: Any) -> tn.Skin:
    return tn.Skin(
        sensor=tn.Sensor(rows=17, columns=17, pitch=PITCH, depth=1.5e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        units={},
        **more,
    )


def carried(readings: NDArray[np.float64]) -> NDArray[np.float64]:
    """Force along x, y and z: what the taxels hold of it."""
    return np.asarray(readings.sum(axis=(0, 1)) * PITCH**2)


@pytest.mark.parametrize(
    ("geom", "rest"), [(BALL, ""), (BOX, ""), (TETRAHEDRON, ASSET)], ids=["ball", "box", "mesh"]
)
def test_the_skin_carries_the_weight(geom: str, rest: str) -> None:
    mjmodel = model(geom, rest=rest)
    data = at_rest(mjmodel)
    readings = tn.mujoco.Pad(mjmodel, site="pad", scene=skin()).read(data)
    assert readings.shape == (17, 17, 3)
    # What lies beyond the skin of 24 mm, of a pressure that falls as depth^3 / r^5: a few per cent.
    assert 0.93 * WEIGHT < carried(readings)[0] < 1.001 * WEIGHT
    assert np.abs(carried(readings)[1:]).max() < 0.03 * WEIGHT


def test_a_ball_reads_as_its_hertz_circle() -> None:
    mjmodel = model(BALL)
    data = at_rest(mjmodel)
    readings = tn.mujoco.Pad(mjmodel, site="pad", scene=skin()).read(data)
    force = np.zeros(6)
    mujoco.mj_contactForce(mjmodel, data, 0, force)
    radius = np.cbrt(3 * force[0] * 0.01 * (1 - 0.45**2) / (4 * 0.2e6))
    x, y, _ = data.contact.pos[0]
    alone = skin(contacts=[tn.Sphere(force=force[0], radius=radius, place=[x, -y])])
    exact = alone.simulate().readings[0]
    assert np.abs(readings - exact).max() < 0.01 * exact.max(), np.abs(readings - exact).max() / exact.max()


def test_a_box_presses_over_its_whole_face() -> None:
    mjmodel = model(BOX)
    readings = tn.mujoco.Pad(mjmodel, site="pad", scene=skin()).read(at_rest(mjmodel))
    pressure = readings[..., 0]
    even = WEIGHT / (12e-3 * 16e-3)
    assert pressure[8, 8] == pytest.approx(even, rel=0.02)
    # Long before the corners' points would: MuJoCo's contacts are four.
    assert pressure[6:11, 5:12].min() > 0.9 * even
    assert np.allclose(pressure, pressure[::-1], atol=0.01 * even)
    assert np.allclose(pressure, pressure[:, ::-1], atol=0.01 * even)


@pytest.mark.parametrize("object_first", [False, True])
@pytest.mark.parametrize(("axis", "channel", "sign"), [(0, 1, 1.0), (1, 2, -1.0)])
def test_drag_has_its_axis_and_its_sign(object_first: bool, axis: int, channel: int, sign: float) -> None:
    """y runs along the site's x axis, z along minus its y axis."""
    mjmodel = model(BOX, object_first=object_first)
    data = at_rest(mjmodel)
    data.xfrc_applied[mujoco.mj_name2id(mjmodel, mujoco.mjtObj.mjOBJ_BODY, "object"), axis] = 0.2
    mujoco.mj_step(mjmodel, data, 200)
    mujoco.mj_forward(mjmodel, data)
    force = carried(tn.mujoco.Pad(mjmodel, site="pad", scene=skin()).read(data))
    # Shear falls as 3 x y^2 / (2 pi r^5): 1.5 depth / r of it lies beyond r, here 12.75 mm and more in the corners.
    assert sign * force[channel] == pytest.approx(0.2 * (1.0 - 1.5 * 1.5 / 13.4), rel=0.1)
    assert abs(force[3 - channel]) < 1e-3


def test_readings_become_tractions_again() -> None:
    scene = skin(noise=tn.Noise(rms=20.0), reconstruct=tn.Reconstruct(alpha="evidence"))
    mjmodel = model(BALL, x=3e-3)
    data = at_rest(mjmodel)
    readings = tn.mujoco.Pad(mjmodel, site="pad", scene=scene).read(data)
    solution = scene.solve(readings)
    assert solution.normal_force[0] == pytest.approx(WEIGHT, rel=0.05)
    assert solution.centre[0] == pytest.approx([data.contact.pos[0, 0], -data.contact.pos[0, 1]], abs=2e-4)


def test_the_sensor_holds_what_read_gives() -> None:
    size = 17 * 17 * 3
    sensor = f'<sensor><user name="taxels" dim="{size}" needstage="acc" objtype="site" objname="pad"/></sensor>'
    mjmodel = model(BALL, x=2e-3, rest=sensor)
    pad = tn.mujoco.Pad(mjmodel, site="pad", scene=skin(noise=tn.Noise(rms=5.0)))
    pad.install()
    data = mujoco.MjData(mjmodel)
    mujoco.mj_step(mjmodel, data, 500)
    mujoco.mj_forward(mjmodel, data)
    held = data.sensor("taxels").data.reshape(17, 17, 3)
    assert np.array_equal(held, pad.read(data)) and np.unravel_index(held[..., 0].argmax(), (17, 17)) in [(9, 8), (10, 8)]


def test_skins_anywhere_and_what_a_skin_takes() -> None:
    mjmodel = model(BALL)
    data = at_rest(mjmodel)
    with pytest.raises(ValueError, match="breadth is of line arrays"):
        tn.mujoco.Pad(mjmodel, site="pad", scene=skin(), breadth=0.02)
    line = tn.Scene(
        sensor=tn.Sensor(count=9, pitch=1e-3, depth=1e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    )
    with pytest.raises(ValueError, match="which must be given"):
        tn.mujoco.Pad(mjmodel, site="pad", scene=line)
    with pytest.raises(ValueError, match="edge_width"):
        tn.mujoco.Pad(mjmodel, site="pad", scene=skin(), edge_width=0.0)
    pad = tn.mujoco.Pad(mjmodel, site="pad", scene=skin(dead_taxels={"indices": [8 * 17 + 8]}))
    readings = pad.read(data)
    assert (readings[8, 8] == 0.0).all() and readings[8, 7, 0] > 0.0
    assert pad.edge_width == 0.75e-3 and pad.breadth is None

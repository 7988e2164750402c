"""What taxels add to a step of MuJoCo, and how fast frames to learn from are made: tools/python bench."""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import tactile_net as tn


def microseconds(call: Callable[[], object], calls: int = 50, batches: int = 400) -> float:
    """The least of many short batches."""
    best = float("inf")
    for _ in range(batches):
        begin = time.perf_counter()
        for _ in range(calls):
            call()
        best = min(best, time.perf_counter() - begin)
    return best / calls * 1e6


def sensor(count: int, pitch: float, reads: list[str]) -> dict[str, Any]:
    return {
        "sensor": tn.Sensor(count=count, pitch=pitch, depth=1.5e-3, reads=reads),
        "material": tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        "units": {},
    }


def frames(contact: tn.Contact, model: str) -> float:
    """Simulated a second, of 41 taxels with noise and a converter."""
    scene = tn.Scene(
        contacts=[contact],
        time=tn.Timing(rate=1000.0, duration=2.0),
        noise=tn.Noise(rms=20.0),
        quantization={"bits": 12, "range": [-4e4, 4e4]},
        forward={"model": model},
        **sensor(41, 0.5e-3, ["stress_x"]),
    )
    return 2000e6 / microseconds(scene.simulate, 1, 40)


moving = [{"t": 0.0, "center": -6e-3, "force": 20.0}, {"t": 2.0, "center": 6e-3, "force": 100.0}]
for model in ("exact", "sampled"):
    rate = frames(tn.Cylinder(half_width=2e-3, trajectory=moving), model)
    print(f"simulated frames of 41 taxels, noise and converter, {model}: {rate:.0f} a second")

if importlib.util.find_spec("mujoco"):
    import warnings

    import mujoco  # type: ignore[import-untyped]

    warnings.filterwarnings("ignore", category=tn.mujoco.ShortContactWarning)
    MODEL = """<mujoco><worldbody><body name="finger"><geom type="box" size=".02 .01 .002"/><site name="pad" pos="0 0 .002"/>
    </body><body pos="0 0 .0119"><joint type="slide" axis="0 0 1"/><geom {} mass=".1"/></body></worldbody><sensor>
    <user dim="{}" needstage="acc" objtype="site" objname="pad"/></sensor></mujoco>"""
    line = tn.Scene(**sensor(21, 1e-3, ["stress_x", "shear_xy"]))
    reads = ["stress_x", "shear_xy", "shear_xz"]
    skin = tn.Skin(
        sensor=tn.Sensor(rows=8, columns=8, pitch=2e-3, depth=2e-3, reads=reads), material=line.to_dict()["material"], units={}
    )
    for name, shape in {
        "ball": 'type="sphere" size=".01"',
        "cylinder": 'type="cylinder" size=".01 .009" euler="90 0 0"',
        "box": 'type="box" size=".006 .009 .01"',
    }.items():
        for scene, breadth in ((line, 20e-3), (skin, None)):
            size = len(scene.reading_names)
            mjmodel = mujoco.MjModel.from_xml_string(MODEL.format(shape, size))
            data = mujoco.MjData(mjmodel)
            mujoco.mj_step(mjmodel, data, 1000)
            bare = microseconds(lambda: mujoco.mj_step(mjmodel, data))
            pad = tn.mujoco.Pad(mjmodel, site="pad", scene=scene, breadth=breadth)
            pad.install()
            sensing = microseconds(lambda: mujoco.mj_step(mjmodel, data), batches=100)
            pad.uninstall()
            print(
                f"{name}, {int(data.ncon)} contacts, {size} readings: a step takes {bare:.1f} us, "
                f"{sensing - bare:.1f} more with taxels"
            )
            assert np.isfinite(data.sensordata).all()

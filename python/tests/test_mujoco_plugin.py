"""The pad as MuJoCo's own plugin: the same bits as the package's pad, and errors that name what is wrong."""

from __future__ import annotations

import copy
import os
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_mujoco import BALL, BAR, BOX, PAD, at_rest, scene

import tactile_net as tn

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install tactile-net[mujoco]")
from mujoco import rollout  # noqa: E402

PLUGIN = os.environ.get("TACTILE_NET_MUJOCO_PLUGIN")
if not PLUGIN:
    pytest.skip("the plugin is not built: -DTACTILE_NET_MUJOCO", allow_module_level=True)
mujoco.mj_loadPluginLibrary(PLUGIN)

pytestmark = pytest.mark.filterwarnings("ignore::tactile_net.mujoco.ShortContactWarning")

SKIN = """
[sensor]
rows = 5
columns = 4
pitch = 2.0e-3
depth = 1.5e-3
reads = ["stress_x", "shear_xy", "shear_xz"]
[material]
youngs_modulus = 0.2e6
poisson_ratio = 0.45
[noise]
rms = 10.0
[units]
"""


@pytest.fixture(autouse=True)
def alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # where MuJoCo writes its log, and where scenes are looked for


def model(geom: str, config: str, *, user: int = 0, sensor: str = 'objtype="site" objname="pad"', pad: str = PAD) -> Any:
    body = f'<body name="object" pos="0 0 .0119"><freejoint/>{geom}</body>'
    other = f'<user name="python" dim="{user}" needstage="acc" objtype="site" objname="pad"/>' if user else ""
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.002"/>'
        f'<extension><plugin plugin="tactile_net.pad"><instance name="pad">{config}</instance></plugin></extension>'
        f"<worldbody>{pad}{body}</worldbody>"
        f'<sensor><plugin name="taxels" instance="pad" {sensor}/>{other}</sensor></mujoco>'
    )


def key(name: str, value: str) -> str:
    return f'<config key="{name}" value="{value}"/>'


LINE = key("scene", "pad.toml") + key("breadth", "20e-3")


@pytest.mark.parametrize("geom", [BALL, BAR, BOX], ids=["ball", "bar", "box"])
def test_it_reads_what_the_package_reads(geom: str) -> None:
    noisy = scene(
        noise=tn.Noise(rms=10.0),
        time=tn.Timing(duration=1.0, rate=500.0),
        viscoelasticity={"terms": [{"fraction": 0.3, "time": 0.1}]},
    )
    Path("pad.toml").write_text(noisy.text, encoding="utf-8")
    mjmodel = model(geom, LINE, user=162)
    pad = tn.mujoco.Pad(mjmodel, site="pad", scene=noisy, breadth=20e-3)
    pad.install()
    try:
        data = mujoco.MjData(mjmodel)
        for _ in range(400):
            mujoco.mj_step(mjmodel, data)
            assert np.array_equal(data.sensor("taxels").data, data.sensor("python").data)
        assert data.sensor("taxels").data.max() > 100.0
    finally:
        pad.uninstall()


def test_a_skin_is_rows_columns_channels() -> None:
    Path("skin.toml").write_text(SKIN, encoding="utf-8")
    mjmodel = model(BALL, key("scene", "skin.toml"), user=60)
    pad = tn.mujoco.Pad(mjmodel, site="pad", scene=tn.Skin.load("skin.toml"))
    pad.install()
    try:
        data = at_rest(mjmodel)
        readings = data.sensor("taxels").data
        assert np.array_equal(readings, data.sensor("python").data)
        carried = readings.reshape(5, 4, 3)[:, :, 0].sum() * 4e-6
        assert carried == pytest.approx(0.981, rel=0.1), "but for what lies beyond the skin, and between its taxels"
    finally:
        pad.uninstall()


def test_copies_and_resets_begin_at_rest_and_rollouts_are_equal() -> None:
    Path("pad.toml").write_text(scene(noise=tn.Noise(rms=10.0)).text, encoding="utf-8")
    mjmodel = model(BALL, LINE)
    data = mujoco.MjData(mjmodel)

    def course(of: Any) -> Any:
        mujoco.mj_resetData(mjmodel, of)
        rows = []
        for _ in range(50):
            mujoco.mj_step(mjmodel, of)
            rows.append(of.sensordata.copy())
        return np.array(rows)

    first = course(data)
    assert np.array_equal(course(data), first)
    assert np.array_equal(course(copy.copy(data)), first)
    state = np.zeros((8, mujoco.mj_stateSize(mjmodel, mujoco.mjtState.mjSTATE_FULLPHYSICS)))
    mujoco.mj_resetData(mjmodel, data)
    mujoco.mj_getState(mjmodel, data, state[0], mujoco.mjtState.mjSTATE_FULLPHYSICS)
    state[:] = state[0]
    _, sensed = rollout.rollout(mjmodel, [mujoco.MjData(mjmodel) for _ in range(2)], state, nstep=500)
    assert np.array_equal(sensed, np.broadcast_to(sensed[0], sensed.shape))
    assert np.array_equal(sensed[0, :50], first)


@pytest.mark.parametrize(
    ("config", "words"),
    [
        ("", 'it needs <config key="scene"'),
        (key("scene", "nowhere.toml") + key("breadth", "20e-3"), "nowhere.toml"),
        (key("scene", "pad.toml"), "a line array needs <config key=.breadth"),
        (key("scene", "pad.toml") + key("breadth", "20 mm"), "breadth must be a number > 0, in m .got '20 mm'"),
        (key("scene", "pad.toml") + key("breadth", "0"), "breadth must be a number > 0"),
        (LINE + key("edge_width", "-1"), "edge_width must be a number > 0"),
        (LINE + key("geoms", "skin glove"), "the model has no geom 'glove'"),
        (LINE + key("width", "1"), "width"),
        (key("scene", "bad.toml") + key("breadth", "20e-3"), "poisson_ratio"),
        (key("scene", "skin.toml") + key("breadth", "20e-3"), "breadth is of line arrays"),
    ],
)
def test_what_is_wrong_is_named(config: str, words: str, capfd: pytest.CaptureFixture[str]) -> None:
    Path("pad.toml").write_text(scene().text, encoding="utf-8")
    Path("bad.toml").write_text(scene().text.replace("0.45", "0.7"), encoding="utf-8")
    Path("skin.toml").write_text(SKIN, encoding="utf-8")
    with pytest.raises(Exception) as refused:  # noqa: PT011: MuJoCo's own kinds of errors
        mujoco.MjData(model(BALL, config))
    log = Path("MUJOCO_LOG.TXT")
    told = str(refused.value) + capfd.readouterr().err + (log.read_text(encoding="utf-8") if log.exists() else "")
    assert re.search(words, told), told


def test_the_sensor_stands_on_a_site() -> None:
    Path("pad.toml").write_text(scene().text, encoding="utf-8")
    with pytest.raises(Exception, match="pad|site|plugin"):  # noqa: PT011
        mujoco.MjData(model(BALL, LINE, sensor='objtype="geom" objname="skin"'))

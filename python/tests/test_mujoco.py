"""Taxels in MuJoCo: they carry the contacts' force, to the right side, at the right place, in every rollout."""

from __future__ import annotations

import copy
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import tactile_net as tn

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install tactile-net[mujoco]")
from mujoco import rollout  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::tactile_net.mujoco.ShortContactWarning")

BREADTH = 20e-3
PAD = '<body name="finger"><geom name="skin" type="box" size=".03 .01 .002"/><site name="pad" pos="0 0 .002"/></body>'
BALL = '<geom type="sphere" size=".01" mass=".1"/>'
BAR = '<geom type="cylinder" size=".01 .008" mass=".1" euler="90 0 0"/>'
BOX = '<geom type="box" size=".006 .008 .01" mass=".1"/>'


def scene(**more: Any) -> tn.Scene:
    return tn.Scene(
        sensor=tn.Sensor(count=81, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x", "shear_xy"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        units={},
        **more,
    )


def model(geom: str, *, x: float = 0.0, pad: str = PAD, object_first: bool = False, rest: str = "") -> Any:
    body = f'<body name="object" pos="{x} 0 .0119"><freejoint/>{geom}</body>'
    bodies = body + pad if object_first else pad + body
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.002"/><worldbody>{bodies}</worldbody>{rest}</mujoco>'
    )


SENSOR = '<sensor><user name="taxels" dim="162" needstage="acc" objtype="site" objname="pad"/></sensor>'


def at_rest(mjmodel: Any) -> Any:
    data = mujoco.MjData(mjmodel)
    mujoco.mj_step(mjmodel, data, 1000)
    mujoco.mj_forward(mjmodel, data)
    return data


def pad_of(mjmodel: Any, of: tn.Scene | None = None, **more: Any) -> tn.mujoco.Pad:
    return tn.mujoco.Pad(mjmodel, site="pad", scene=of or scene(), breadth=BREADTH, **more)


def carried(readings: NDArray[np.float64]) -> float:
    return float(readings[0].sum() * 0.5e-3 * BREADTH)


@pytest.fixture(autouse=True)
def nothing_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.chdir(tmp_path)  # where MuJoCo writes its log
    yield
    mujoco.set_mjcb_sensor(None)
    tn.mujoco._installed.clear()


@pytest.mark.parametrize("geom", [BALL, BAR, BOX], ids=["ball", "bar", "box"])
def test_the_taxels_carry_the_weight(geom: str) -> None:
    mjmodel = model(geom)
    readings = pad_of(mjmodel).read(at_rest(mjmodel))
    assert readings.shape == (2, 81)
    assert carried(readings) == pytest.approx(0.981, rel=2e-3), "but for what lies beyond the array"
    assert abs(readings[1].sum()) < 1e-2 * readings[0].sum()


def test_a_round_object_reads_as_hertz_cylinder() -> None:
    mjmodel = model(BAR, x=1e-3)
    pressure = 0.981 / BREADTH
    half = np.sqrt(4 * pressure * 0.01 * (1 - 0.45**2) / (np.pi * 0.2e6))
    data = at_rest(mjmodel)
    centre = float(data.body("object").xpos[0])
    alone = scene(contacts=[tn.Cylinder(force=pressure, half_width=float(half), center=centre)]).simulate().readings[0]
    assert pad_of(mjmodel).read(data) == pytest.approx(alone, abs=2e-3 * alone.max())


def test_a_box_presses_over_its_whole_face() -> None:
    mjmodel = model(BOX)
    data = at_rest(mjmodel)
    assert data.ncon >= 4
    normal = pad_of(mjmodel).read(data)[0]
    assert normal[40] > 0.95 * normal.max(), "MuJoCo's corners alone would leave the middle empty"
    uniform = 0.981 / BREADTH / 12e-3
    assert normal[40] == pytest.approx(uniform, rel=0.05)


def test_drag_has_its_sign_for_both_orders_of_the_geoms() -> None:
    found = []
    for object_first in (False, True):
        mjmodel = model(BOX, object_first=object_first)
        data = at_rest(mjmodel)
        data.body("object").xfrc_applied[[0, 4]] = 0.2, -0.2 * 10e-3  # as if at the pad's face
        mujoco.mj_step(mjmodel, data, 100)
        mujoco.mj_forward(mjmodel, data)
        skin = mjmodel.geom("skin").id
        assert {row.tolist().index(skin) for row in data.contact.geom} == {1 if object_first else 0}
        found.append(pad_of(mjmodel).read(data))
    assert found[0] == pytest.approx(found[1], abs=1e-3 * found[0].max())
    dragged = scene(contacts=[tn.Cylinder(force=49.0, half_width=1.6e-3, friction=0.2)]).simulate().readings[0]
    assert dragged[1].sum() > 0, "along y, as the scene's friction"
    # Of the tangential force the shear along the array carries all, but for its tails beyond the array's ends.
    end, depth = 20.25e-3, 1.5e-3
    seen = 2 / np.pi * (np.arctan(end / depth) - depth * end / (depth**2 + end**2))
    assert found[0][1].sum() * 0.5e-3 * BREADTH == pytest.approx(0.2 * seen, rel=0.01)


def test_a_mirrored_scene_has_mirrored_readings() -> None:
    here, there = (pad_of(m).read(at_rest(m)) for m in (model(BALL, x=4e-3), model(BALL, x=-4e-3)))
    scale = here.max()
    assert here[0] == pytest.approx(there[0, ::-1], abs=1e-6 * scale)
    assert here[1] == pytest.approx(-there[1, ::-1], abs=1e-6 * scale)
    assert np.abs(here[0] - there[0]).max() > 0.5 * scale


def test_the_readings_follow_a_moving_ball() -> None:
    mjmodel = model(BALL)
    data = mujoco.MjData(mjmodel)
    pad = pad_of(mjmodel)
    for x in np.linspace(-8e-3, 8e-3, 9):
        data.qpos[:3] = x, 0.0, 0.0119
        data.time += 0.1
        mujoco.mj_forward(mjmodel, data)
        normal = pad.read(data)[0]
        near = np.abs(pad.scene.taxels - x) < 8e-3
        centre = (normal * pad.scene.taxels)[near].sum() / normal[near].sum()
        assert centre == pytest.approx(x, abs=0.1 * 0.5e-3)


def test_a_turned_pad_reads_the_same() -> None:
    """The site's axes count, not the world's: the pad and gravity upside down."""
    flipped = '<body name="finger" euler="180 0 0">' + PAD.partition(">")[2]
    mjmodel = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="0 0 9.81"/><worldbody>{flipped}<body name="object" pos=".003 0 -.0119"><freejoint/>'
        f"{BALL}</body></worldbody></mujoco>"
    )
    upright = model(BALL, x=3e-3)
    assert pad_of(mjmodel).read(at_rest(mjmodel)) == pytest.approx(pad_of(upright).read(at_rest(upright)), abs=5.0)


def test_the_sensor_holds_what_read_gives() -> None:
    mjmodel = model(BALL, rest=SENSOR)
    pad = pad_of(mjmodel, scene(noise=tn.Noise(rms=20.0), quantization={"bits": 10, "range": [-2e4, 2e4]}))
    pad.install()
    pad.install()
    data = at_rest(mjmodel)
    levels = data.sensordata * 1023 / 4e4 + 1023 / 2
    assert levels == pytest.approx(np.round(levels), abs=1e-9), "quantised: the effects are the scene's"
    assert np.array_equal(pad.read(data).ravel(), data.sensordata)
    pad.uninstall()
    assert mujoco.get_mjcb_sensor() is None


def test_another_callback_is_still_called() -> None:
    mjmodel = model(BALL, rest=SENSOR)  # before any callback: MuJoCo compiles none with user sensors then
    other = model(BOX, rest=SENSOR.replace("162", "3"))
    pad = pad_of(mjmodel)
    heard: list[int] = []
    mujoco.set_mjcb_sensor(lambda model, data, stage: heard.append(stage))
    pad.install()
    data = at_rest(mjmodel)
    assert heard and data.sensordata.max() > 0
    mujoco.mj_step(other, unlike := mujoco.MjData(other))
    assert not unlike.sensordata.any(), "a sensor of another model is not the pad's"
    pad.uninstall()
    heard.clear()
    mujoco.mj_step(mjmodel, data)
    assert heard


def test_rollouts_are_equal_on_any_number_of_threads() -> None:
    mjmodel = model(BALL, rest=SENSOR)
    creeps = {"terms": [{"fraction": 0.4, "time": 0.05}]}
    time = tn.Timing(rate=500.0, duration=1.0)  # which the simulation's own stands for
    pad = pad_of(mjmodel, scene(noise=tn.Noise(rms=20.0), viscoelasticity=creeps, time=time))
    pad.install()
    full = mujoco.mjtState.mjSTATE_FULLPHYSICS
    states = np.zeros((8, mujoco.mj_stateSize(mjmodel, full)))
    data = mujoco.MjData(mjmodel)
    for k, state in enumerate(states):
        mujoco.mj_resetData(mjmodel, data)
        data.qpos[0] = 1e-3 * k
        mujoco.mj_getState(mjmodel, data, state, full)
    alone = rollout.rollout(mjmodel, mujoco.MjData(mjmodel), states, nstep=500)[1]
    datas = [mujoco.MjData(mjmodel) for _ in range(2)]
    with rollout.Rollout(nthread=2) as pool:
        together = pool.rollout(mjmodel, datas, states, nstep=500)[1]
    assert alone.shape == (8, 500, 162) and alone[:, -1].max() > 1000
    assert np.array_equal(alone, together)
    assert not np.array_equal(alone[0], alone[1])


def test_a_copy_of_the_data_has_a_sensor_of_its_own() -> None:
    mjmodel = model(BALL)
    pad = pad_of(mjmodel)
    data = at_rest(mjmodel)
    readings = pad.read(data)
    assert np.array_equal(pad.read(copy.copy(data)), readings)

    noisy = pad_of(mjmodel, scene(noise=tn.Noise(rms=20.0)))
    first = noisy.read(data)
    assert np.array_equal(noisy.read(data), first), "the same moment reads the same"
    assert np.array_equal(noisy.read(copy.copy(data)), first), "and begins with the same noise"
    data.time += 0.01
    assert not np.array_equal(noisy.read(data), first)


def test_sensors_are_forgotten_with_their_data() -> None:
    mjmodel = model(BALL)
    pad = pad_of(mjmodel)
    all_data = [mujoco.MjData(mjmodel) for _ in range(50)]
    for data in all_data:
        pad.read(data)
    assert len(pad._known) == 50
    del data, all_data
    assert not pad._known


def test_nothing_that_touches_reads_nothing() -> None:
    mjmodel = model(BALL)
    data = mujoco.MjData(mjmodel)
    data.qpos[2] = 1.0
    mujoco.mj_forward(mjmodel, data)
    assert not pad_of(mjmodel).read(data).any()
    unfelt = model('<geom type="sphere" size=".01" mass=".1" margin="0" gap=".01"/>')
    data = mujoco.MjData(unfelt)
    data.qpos[2] = 0.015
    mujoco.mj_forward(unfelt, data)
    assert data.ncon == 1 and not pad_of(unfelt).read(data).any(), "a contact without force"


def test_what_touches_beside_or_behind_is_left_out() -> None:
    inverted = PAD.replace('pos="0 0 .002"', 'pos="0 0 .002" euler="180 0 0"')
    mjmodel = model(BALL, pad=inverted)
    with pytest.warns(UserWarning, match="pulls at the pad 'pad'.*z axis must point out of it"):
        assert not pad_of(mjmodel).read(at_rest(mjmodel)).any()
    beside = PAD.replace('pos="0 0 .002"', 'pos="0 0 .002" euler="0 90 0"')
    mjmodel = model(BALL, pad=beside)
    assert not pad_of(mjmodel).read(at_rest(mjmodel)).any()


def test_a_flex_is_left_out_and_told_of_once(recwarn: pytest.WarningsRecorder) -> None:
    cloth = (
        '<flexcomp name="cloth" type="grid" count="4 4 1" spacing=".01 .01 .01" mass=".1" radius=".002" pos="0 0 .004">'
        '<contact selfcollide="none"/></flexcomp>'
    )
    mjmodel = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{PAD}{cloth}</worldbody></mujoco>")
    data = mujoco.MjData(mjmodel)
    mujoco.mj_step(mjmodel, data, 5)
    assert data.ncon > 0
    pad = pad_of(mjmodel)
    assert not pad.read(data).any() and not pad.read(data).any()
    assert [str(one.message) for one in recwarn] == ["a flex touches the pad 'pad', and is left out: only geoms are taken"]


def test_plane_strain_is_warned_of_where_it_does_not_hold() -> None:
    warnings.simplefilter("error", tn.mujoco.ShortContactWarning)
    for geom, is_short in ((BALL, True), (BAR, False), (BOX, False)):
        mjmodel = model(geom, rest=SENSOR)
        pad = pad_of(mjmodel)
        data = at_rest(mjmodel)
        if not is_short:
            pad.read(data)
            continue
        pad.install()
        with pytest.raises(tn.mujoco.ShortContactWarning, match="shorter across the array than three depths"):
            mujoco.mj_step(mjmodel, data)  # the error goes through MuJoCo
        pad.uninstall()


def test_what_a_model_must_have() -> None:
    mjmodel = model(BALL)
    with pytest.raises(ValueError, match="the model has no site 'pda': it has 'pad'"):
        tn.mujoco.Pad(mjmodel, site="pda", scene=scene(), breadth=BREADTH)
    with pytest.raises(ValueError, match="the model has no site 'skin'"):
        tn.mujoco.Pad(mjmodel, site="skin", scene=scene(), breadth=BREADTH)
    with pytest.raises(ValueError, match="the model has no geom 'skn': it has 'skin'"):
        pad_of(mjmodel, geoms=["skn"])
    bare = '<body name="finger"><site name="pad"/><body><geom name="skin" type="box" size=".03 .01 .002"/></body></body>'
    inner = model(BALL, pad=bare)
    with pytest.raises(ValueError, match="the body of the site 'pad' has no geom"):
        pad_of(inner)
    assert carried(pad_of(inner, geoms=["skin"]).read(at_rest(inner))) == pytest.approx(0.981, rel=2e-3)
    with pytest.raises(TypeError, match="model must be a mujoco.MjModel, got str"):
        tn.mujoco.Pad("model.xml", site="pad", scene=scene(), breadth=BREADTH)


def test_what_a_sensor_must_be() -> None:
    line = '<user name="taxels" dim="162" needstage="acc" objtype="site" objname="pad"/>'
    for rest, sentence in (
        ("", "the model has 0 user sensors on the site 'pad', not this one: "),
        (SENSOR.replace("162", "42"), "has dim 42, the scene has 162 readings: "),
        (SENSOR.replace("acc", "pos"), 'must have needstage="acc"'),
        (f'<sensor>{line}{line.replace("taxels", "b")}</sensor>', "the model has 2 user sensors"),
    ):
        pad = pad_of(model(BALL, rest=rest))
        with pytest.raises(ValueError) as error:
            pad.install()
        assert sentence in str(error.value) and (line in str(error.value) or "acc" in sentence)
    assert mujoco.get_mjcb_sensor() is None


@pytest.mark.parametrize("breadth", [0.0, -1.0, np.nan, np.inf])
def test_widths_are_lengths(breadth: float) -> None:
    mjmodel = model(BALL)
    with pytest.raises(ValueError, match="breadth must be"):
        tn.mujoco.Pad(mjmodel, site="pad", scene=scene(), breadth=breadth)
    with pytest.raises(ValueError, match="edge_width must be"):
        pad_of(mjmodel, edge_width=breadth)
    assert pad_of(mjmodel).edge_width == 0.75e-3


def test_scenes_are_judged_by_their_reader(tmp_path: Path) -> None:
    mjmodel = model(BALL)
    with pytest.raises(FileNotFoundError):
        tn.mujoco.Pad(mjmodel, site="pad", scene=tmp_path / "pad.toml", breadth=BREADTH)
    good = scene().text
    for old, new, sentence in (
        ("0.0015", "-0.0015", "depth"),
        ("0.0015", '"1 mm"', "depth"),
        ("0.45", "0.7", "poisson_ratio"),
        ("stress_x", "stress_z", "stress_z"),
        ("count = 81", "count = 0", "count"),
        ("count = 81", "count = 100000000", "count"),
        ("depth", "dept", "dept"),
    ):
        assert old in good
        (tmp_path / "pad.toml").write_text(good.replace(old, new))
        with pytest.raises(tn.InputError, match=sentence):
            tn.mujoco.Pad(mjmodel, site="pad", scene=tmp_path / "pad.toml", breadth=BREADTH)


def test_scenes_of_other_units_and_uneven_arrays() -> None:
    mjmodel = model(BALL)
    data = at_rest(mjmodel)
    text = (
        '[units]\nlength = "mm"\nstress = "kPa"\nmodulus = "kPa"\n[sensor]\ncount = 81\npitch = 0.5\ndepth = 1.5\n'
        'reads = ["stress_x", "shear_xy"]\n[material]\nyoungs_modulus = 200\npoisson_ratio = 0.45\n'
    )
    in_millimetres = pad_of(mjmodel, tn.Scene.parse(text)).read(data)
    assert in_millimetres == pytest.approx(pad_of(mjmodel).read(data), rel=1e-12)
    kilopascals = pad_of(mjmodel, tn.Scene.parse(text)).scene.raw_numbers(in_millimetres)
    assert kilopascals == pytest.approx(1e-3 * in_millimetres), "readings are in SI, as all that the package gives"
    uneven = tn.Scene.parse(text.replace("count = 81\npitch = 0.5", "positions = [-20, -1, 0, 2]"))
    few = pad_of(mjmodel, uneven).read(data)
    assert few.shape == uneven.reading_shape and few.ravel()[:4].argmax() == 2

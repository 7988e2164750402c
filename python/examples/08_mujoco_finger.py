# %% [markdown]
# # Two fingers in MuJoCo: readings, tractions, friction margin
#
# A gripper closes on a box, then on a ball, lifts it, and loosens its grip until it slips. MuJoCo logs what the taxels
# of both pads read as user sensors; all that is drawn below comes from these readings.

# %%
import warnings

import matplotlib.pyplot as plt
import mujoco  # type: ignore[import-untyped]
import numpy as np

import tactile_net as tn

# A ball's contact is short: its force is right, the height of its readings is that of a long contact.
warnings.filterwarnings("ignore", category=tn.mujoco.ShortContactWarning)
FINGER = """<body name="{0}" pos="{1} 0 0"><joint name="{0}" axis="{2} 0 0" type="slide" damping="2"/>
  <geom type="box" size=".004 .01 .015" mass=".05" friction=".6 0 0"/>
  <site name="{0}" pos="{3} 0 0" xyaxes="0 0 1 0 {4} 0"/></body>"""
MODEL = """<mujoco><option timestep=".001" cone="elliptic" impratio="10"/><worldbody>
<geom type="box" size=".005 .005 .0055" pos="0 0 .0055"/><body pos="0 0 .021"><geom size=".01" pos="0 0 .1" mass=".2"/>
<joint name="lift" axis="0 0 1" type="slide" damping="20"/>{0}{1}</body>
<body pos="0 0 {2}"><freejoint/><geom {3} mass=".1" friction=".6 0 0"/></body></worldbody>
<actuator><motor joint="left"/><motor joint="right"/><position joint="lift" kp="4000"/></actuator>
<sensor><user dim="82" needstage="acc" objtype="site" objname="left"/>
<user dim="82" needstage="acc" objtype="site" objname="right"/></sensor></mujoco>"""
FINGERS = FINGER.format("left", -0.025, 1, 0.004, -1), FINGER.format("right", 0.025, -1, -0.004, 1)
OBJECTS = {"box": (0.02, 'type="box" size=".015 .01 .009"'), "ball": (0.023, 'size=".012"')}

# %%
scene = tn.Scene.load("scenes/mujoco/pad.toml")
plan = scene.plan(accuracy=1e-6, friction=0.6)
t = 1e-3 * np.arange(2000)
figure, axes = plt.subplots(3, 2, figsize=(10, 8), sharex=True, layout="constrained")
for (name, (height, shape)), (above, middle, below) in zip(OBJECTS.items(), axes.T):
    model = mujoco.MjModel.from_xml_string(MODEL.format(*FINGERS, height, shape))
    for side in ("left", "right"):
        tn.mujoco.Pad(model, site=side, scene=scene, breadth=20e-3).install()
    data, log = mujoco.MjData(model), np.empty((2000, 2, 82))
    for k in range(2000):
        grip = np.interp(t[k], [0.0, 0.2, 1.0, 2.0], [0.5, 4.0, 4.0, 0.4])
        data.ctrl[:] = grip, grip, np.interp(t[k], [0.4, 0.8], [0.0, 0.03])
        mujoco.mj_step(model, data)
        log[k] = data.sensordata.reshape(2, 82)
    above.set(title=name)
    left = tn.Estimator(plan).update_batch(log[:, 0])
    above.pcolormesh(t, 1e3 * scene.y, 1e-3 * left.reshape(2000, 2, -1)[:, 0].T)
    for finger, side in enumerate(("left", "right")):
        estimator, contacts = tn.Estimator(plan), []
        for frame in log[:, finger]:
            estimator.update(frame)
            contacts.append((estimator.contact.normal_force, estimator.contact.friction_margin))
        force, margin = np.array(contacts).T
        middle.plot(t, 20e-3 * force, label=side)
        below.plot(t, np.where(force > 10.0, margin, np.nan), label=side)
    slipped = t[(t > 1.0) & (margin < 0.02 * force)]
    print(f"{name}: {20e-3 * force[900]:.2f} N at 0.9 s, the margin is gone at {slipped[0]:.2f} s")

# %% [markdown]
# # Two fingers in MuJoCo: readings, tractions, slip margin
#
# A gripper closes on a box, then on a ball, lifts it, and loosens its grip until it slips. MuJoCo logs what the taxels
# of both pads read; all that is drawn comes from that. Friction is 1.

# %%
import warnings

import matplotlib.pyplot as plt
import mujoco  # type: ignore[import-untyped]
import numpy as np

import tactile_net as tn

FINGER = """<body pos="{1} 0 0"><joint name="{0}" axis="{2} 0 0" type="slide" damping="2"/>
<site name="{0}" pos="{3} 0 0" xyaxes="0 0 1 0 {4} 0"/><geom type="box" size=".004 .01 .015" mass=".05"/></body>"""
FINGERS = FINGER.format("left", -0.025, 1, 0.004, -1) + FINGER.format("right", 0.025, -1, -0.004, 1)
MODEL = """<mujoco><option timestep=".001" cone="elliptic" impratio="10"/><worldbody>
<geom type="box" size=".005 .005 .0055" pos="0 0 .0055"/><body pos="0 0 .021"><geom size=".01" pos="0 0 .1" mass=".2"/>
<joint name="lift" axis="0 0 1" type="slide" damping="20"/>{}</body><body pos="0 0 {}"><freejoint/><geom {} mass=".1"/>
</body></worldbody><actuator><motor joint="left"/><motor joint="right"/><position joint="lift" kp="4000"/></actuator>
<sensor><user dim="82" needstage="acc" objtype="site" objname="left"/>
<user dim="82" needstage="acc" objtype="site" objname="right"/></sensor></mujoco>"""
OBJECTS = {"box": (0.02, 'type="box" size=".015 .01 .009"'), "ball": (0.023, 'size=".012"')}
MODELS = {name: mujoco.MjModel.from_xml_string(MODEL.format(FINGERS, *it)) for name, it in OBJECTS.items()}
# A ball's contact is short across the pad: its force is right, the height of its readings is that of a long one.
warnings.filterwarnings("ignore", category=tn.mujoco.ShortContactWarning)

# %%
scene = tn.Scene(
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x", "shear_xy"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    noise=tn.Noise(rms=10.0),
    reconstruct=tn.Reconstruct(alpha=1e-3),
    units={},
)
t = 1e-3 * np.arange(2000)
figure, axes = plt.subplots(3, 2, figsize=(10, 8), sharex=True, sharey="row", layout="constrained")
for (name, model), (above, middle, below) in zip(MODELS.items(), axes.T):
    for side in ("left", "right"):
        tn.mujoco.Pad(model, site=side, scene=scene, breadth=20e-3).install()
    data, log = mujoco.MjData(model), np.empty((2000, 2, 2, 41))  # (t, finger, channel, taxel)
    grip, lift = np.interp(t, [0.0, 0.2, 1.0, 2.0], [0.5, 4.0, 4.0, 0.2]), np.interp(t, [0.4, 0.8], [0.0, 0.03])
    for k in range(2000):
        data.ctrl[:] = grip[k], grip[k], lift[k]
        mujoco.mj_step(model, data)
        log[k] = data.sensordata.reshape(2, 2, 41)
    tractions = scene.solver()(log)
    force = 20e-3 * scene.spacing * tractions.sum(axis=-1)  # (t, finger, component) [N]
    above.pcolormesh(t, 1e3 * scene.y, 1e-3 * tractions[:, 0, 0].T)
    above.set(title=f"{name}: tractions on the left", ylabel="y [mm]")
    middle.plot(t, force[:, 0], label=["normal", "tangential"])
    below.plot(t, 1 - np.abs(force[..., 1]) / np.where(force[..., 0] > 0.2, force[..., 0], np.nan))
    below.set(xlabel="t [s]", ylabel="slip margin", ylim=(-0.2, 1))
    print(f"{name}: {force[900, 0, 0]:.2f} N at 0.9 s, of 4; {-force[900, 0, 1]:.2f} N along the pad, of 0.49")
middle.legend(frameon=False, title="force on the left [N]")
figure.savefig("mujoco-finger.png")
print("their slip margins are in mujoco-finger.png")

# %% [markdown]
# # A skin in MuJoCo: a ball, a box and a mesh lie on it, and one of them is pushed
#
# A controller's call turns every frame into forces as the simulation goes on; the last frame is then solved in full.

# %%
import matplotlib.pyplot as plt
import mujoco  # type: ignore[import-untyped]
import numpy as np

import tactile_net as tn

OBJECTS = {
    "ball": (0.10, -0.009, -0.008, 'type="sphere" size=".008" condim="6" friction="1 .05 .01"'),
    "box": (0.15, 0.008, -0.008, 'type="box" size=".005 .004 .006"'),
    "mesh": (0.10, 0.000, 0.008, 'type="mesh" mesh="foot"'),
}
BODY = '<body name="{0}" pos="{2} {3} .0125"><freejoint/><geom {4} mass="{1}"/></body>'
model = mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep=".001" cone="elliptic" impratio="10"/>
<asset><mesh name="foot" vertex="-.006 -.004 -.006 .006 -.004 -.006 0 .006 -.006 0 0 .012"/></asset>
<worldbody><geom type="box" size=".02 .02 .002"/><site name="skin" pos="0 0 .002"/>
{"".join(BODY.format(name, *rest) for name, rest in OBJECTS.items())}</worldbody></mujoco>""")

# %%
skin = tn.Skin(
    sensor=tn.Sensor(rows=16, columns=16, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    noise=tn.Noise(rms=10.0),
    units={},
)
pad = tn.mujoco.Pad(model, site="skin", scene=skin)
mujoco.mj_step(model, data := mujoco.MjData(model), 1000)
estimator = tn.Estimator(skin.plan(accuracy=1e-4, readings=pad.read(data)))
t, found = 1e-3 * np.arange(300), np.empty((300, 3))
push = np.interp(t, [0.05, 0.25], [0.0, 0.6])  # along the site's x axis, which is the skin's y
for k in range(300):
    data.body("box").xfrc_applied[0] = push[k]
    mujoco.mj_step(model, data)
    estimator.update(pad.read(data))
    found[k] = (one := estimator.contact).normal_force, one.tangential_y, one.tangential_z
weight = 9.81 * sum(mass for mass, *_ in OBJECTS.values())
print(f"{found[40, 0]:.2f} N on the skin, of {weight:.2f}; pushed by {push[-1]:.2f} N it drags by {found[-1, 1]:.2f} N")

# %%
solution = skin.solve(pad.read(data))
print(f"{solution.contacts[0]} objects lie apart; together {solution.normal_force[0]:.2f} N, {solution.verdict[0]}")
y, z = np.meshgrid(skin.y, skin.z, indexing="ij")
at = {name: np.hypot(y - data.body(name).xpos[0], z + data.body(name).xpos[1]) for name in OBJECTS}
for name, (mass, *_) in OBJECTS.items():
    own = at[name] == np.min(list(at.values()), axis=0)
    p, q_y, _ = skin.cell_area * solution.tractions[0, :, own & solution.touching[0]].sum(axis=0)
    print(f"{name}: {p:.2f} N, of {9.81 * mass:.2f}; dragged by {q_y:.2f} N")
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
tn.plot.tractions(solution, ax=left)
right.plot(t, found, label=["into the skin", "along y", "along z"])
right.plot(t, push, "k:", label="push")
right.set(xlabel="t [s]", ylabel="force [N]")
right.legend(frameon=False)
figure.savefig("mujoco-skin.png", dpi=110)

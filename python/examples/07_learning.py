# %% [markdown]
# # Learning through the inverse: a data set, and gradients without a framework
#
# Forward and inverse are constant matrices. A sensor's gains are unknown; they are learned from frames whose tractions
# are known, through the solver: `vjp` is M' g. docs/mujoco.md has the same as a function for PyTorch.

# %%
import matplotlib.pyplot as plt
import numpy as np

import tactile_net as tn

draw = np.random.default_rng(1)
presses = [{"t": 0.02 * k, "force": draw.uniform(20, 100), "center": draw.uniform(-8e-3, 8e-3)} for k in range(100)]
scene = tn.Scene(
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(half_width=2e-3, trajectory=presses)],
    time=tn.Timing(rate=1000.0, duration=2.0),
    noise=tn.Noise(rms=20.0),
    quantization={"bits": 12, "range": [-4e4, 4e4]},
    gain_error={"rms": 0.1, "seed": 7},
    reconstruct=tn.Reconstruct(alpha=1e-4),
)
recording = scene.simulate()
readings, truth = recording.readings, np.asarray(recording.truth)
np.savez_compressed("frames.npz", readings=readings.astype(np.float32), tractions=truth.astype(np.float32))
print(f"{len(recording)} frames of {readings[0].size} readings are in frames.npz")

# %% [markdown]
# The loss is the tractions' squared error. Its gradient takes the way forward, `solver`, and the way back, `vjp`; here
# conjugate gradients follow it, where a network has its optimiser.

# %%
solver, corrections, losses = scene.solver(), np.ones(41), []
offset = -(solver.vjp(truth) * readings).sum(axis=(0, 1))
direction = left = -(solver.vjp(solver(corrections * readings)) * readings).sum(axis=(0, 1)) - offset
for step in range(30):
    losses.append(float(((solver(corrections * readings) - truth) ** 2).mean()) ** 0.5)
    curved = (solver.vjp(solver(direction * readings)) * readings).sum(axis=(0, 1))
    corrections = corrections + (length := left @ left / (direction @ curved)) * direction
    before, left = left, left - length * curved
    direction = left + left @ left / (before @ before) * direction

# %%
ideal = (truth.reshape(len(truth), -1) @ scene.kernel_matrix().T).reshape(readings.shape)
gains = (readings * ideal).sum(axis=(0, 1)) / (ideal**2).sum(axis=(0, 1))
figure, (above, below) = plt.subplots(2, figsize=(8, 7), layout="constrained")
above.plot(np.array(losses) / 1e3)
above.set(xlabel="step", ylabel="rms error of the tractions [kPa]", ylim=(0, None))
below.plot(1e3 * scene.taxels, gains, "o", label="of the sensor")
below.plot(1e3 * scene.taxels, 1 / corrections, label="learned")
below.set(xlabel="y [mm]", ylabel="gain")
below.legend(frameon=False)
figure.savefig("learning.png")
print(f"rms error of the tractions: {losses[0]:.0f} Pa, then {losses[-1]:.0f} Pa")
print(f"the gains' rms error: {np.std(gains):.3f}, then {np.sqrt(np.mean((1 / corrections - gains) ** 2)):.3f}")

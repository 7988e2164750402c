# %% [markdown]
# # Learning through the inverse: a data set, and gradients without a framework
#
# Forward and inverse are constant matrices. A sensor's gains are unknown; they are learned from frames whose tractions
# are known, by descending through the solver: `vjp` is M' g. docs/mujoco.md has the same as a torch function.

# %%
import matplotlib.pyplot as plt
import numpy as np

import tactile_net as tn

draw = np.random.default_rng(1)
presses = [
    {"t": 0.02 * k, "force": draw.uniform(20.0, 100.0), "center": draw.uniform(-6e-3, 6e-3)} for k in range(100)
]
scene = tn.Scene(
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(half_width=2e-3, trajectory=presses)],
    time=tn.Timing(rate=1000.0, duration=2.0),
    noise=tn.Noise(rms=20.0),
    quantization={"bits": 12, "range": [-4e4, 4e4]},
    gain_error={"rms": 0.1, "seed": 7},
    reconstruct=tn.Reconstruct(alpha=1e-3),
)
recording = scene.simulate()
assert recording.truth is not None
np.savez_compressed(
    "frames.npz", readings=recording.readings.astype(np.float32), tractions=recording.truth.astype(np.float32)
)
print(f"{len(recording)} frames of {recording.readings[0].size} readings are in frames.npz")

# %% [markdown]
# What a layer of any framework needs: a forward pass, and what the loss changes by with its inputs.

# %%
solver = scene.solver()
readings, truth = recording.readings, recording.truth
ideal = (truth.reshape(len(truth), -1) @ scene.kernel_matrix().T).reshape(readings.shape)
corrections, losses = np.ones(41), []
for epoch in range(200):
    tractions = solver(corrections * readings)
    wrong = tractions - truth
    losses.append(float((wrong**2).mean()) ** 0.5)
    slope = (solver.vjp(wrong) * readings).sum(axis=(0, 1))
    scale = (solver.vjp(solver(np.abs(readings))) * np.abs(readings)).sum(axis=(0, 1))
    corrections -= 0.5 * slope / np.abs(scale).max()

# %%
gains = (readings * ideal).sum(axis=(0, 1)) / (ideal**2).sum(axis=(0, 1))
figure, (above, below) = plt.subplots(2, figsize=(8, 7), layout="constrained")
above.semilogy(np.array(losses) / 1e3)
above.set(xlabel="epoch", ylabel="rms error of the tractions [kPa]")
below.plot(1e3 * scene.taxels, gains, "o", label="of the sensor")
below.plot(1e3 * scene.taxels, 1 / corrections, label="learned")
below.set(xlabel="y [mm]", ylabel="gain")
below.legend(frameon=False)
figure.savefig("learning.png")
print(f"rms error of the tractions: {losses[0]:.0f} Pa, then {losses[-1]:.0f} Pa")
print(f"largest error of a gain: {np.abs(1 / corrections - gains).max():.3f}")

# %% [markdown]
# # Uncertainty done right
#
# A band is worth something if it holds the truth as often as it says. Simulate a hundred contacts, and count.

# %%
import matplotlib.pyplot as plt
import numpy as np

import tactile_net as tn

scene = tn.Scene(
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(force=100.0, half_width=2e-3)],
    noise=tn.Noise(rms=20.0),
)
random = np.random.default_rng(1)
inside, forces, stated = [], [], []
for seed in range(100):
    contact = {
        "force": random.uniform(20, 200),
        "half_width": random.uniform(1e-3, 4e-3),
        "center": random.uniform(-4e-3, 4e-3),
    }
    one = scene.replace({f"contact.0.{key}": value for key, value in contact.items()} | {"noise.seed": seed})
    recording = one.simulate()
    solution = recording.solve()
    assert recording.truth is not None
    inside.append(np.abs(solution.tractions - recording.truth) <= 2 * solution.deviation)
    forces.append(solution.normal_force[0] - contact["force"])
    stated.append(solution.normal_force_deviation[0])

# %%
held = np.mean(inside, axis=0)[0, 0]
print(f"two deviations hold the truth at {100 * np.mean(held):.1f} % of all points and contacts")
print(f"the force errs by {np.std(forces):.2f} N/m, and is said to err by {np.sqrt(np.mean(np.square(stated))):.2f}")
assert np.mean(held) > 0.9

# %% [markdown]
# Bands know noise and smoothing only. A pad other than stated shows elsewhere: in the verdict of the data.

# %%
wrong = scene.replace({"sensor.depth": 2.0e-3}).solve(scene.simulate())
print(f"solved for a depth that is not the pad's: data {wrong.data[0]}", *wrong.notes, sep="\n")

# %%
figure, ax = plt.subplots(figsize=(8, 4), layout="constrained")
ax.plot(1e3 * scene.y, 100 * held)
ax.axhline(95, color="0.8")
ax.set_ylim(90, 100.5)
ax.set_xlabel("y [mm]")
ax.set_ylabel("truth within two deviations [%]")
figure.savefig("uncertainty.png")

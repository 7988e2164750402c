# %% [markdown]
# # Which sensors to buy
#
# Before there is a sensor: what would this one tell, and what would others in its place?

# %%
import matplotlib.pyplot as plt

import tactile_net as tn

scene = tn.Scene(
    sensor=tn.Sensor(count=21, pitch=1e-3, depth=2e-3, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(force=100.0, half_width=3e-3, friction=0.3)],
    noise=tn.Noise(rms=50.0),
    units={},  # SI
)
survey = scene.identify()
print(survey)
for row in survey.table[:8]:
    print("  ".join(row.values()))

# %% [markdown]
# The shortest wavelength that is told from noise, over depth and noise. No array sees less than two pitches.

# %%
depths = [0.5e-3, 1e-3, 2e-3, 3e-3, 4e-3, 6e-3]
figure, ax = plt.subplots(figsize=(8, 4), layout="constrained")
for rms in (5.0, 50.0, 500.0):
    told = []
    for depth in depths:
        normal = scene.replace({"sensor.depth": depth, "noise.rms": rms}).identify().normal
        told.append(float("nan") if normal is None else 1e3 * normal)
    print(f"noise {rms:g} Pa:", *(f"{wavelength:.1f} mm" for wavelength in told))
    ax.plot([1e3 * depth for depth in depths], told, "o-", label=f"noise {rms:g} Pa")
ax.set_xlabel("depth [mm]")
ax.set_ylabel("shortest wavelength told [mm]")
ax.legend(frameon=False)
figure.savefig("which-sensors.png")

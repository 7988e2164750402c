# %% [markdown]
# # A skin: three tractions from taxels in rows and columns
#
# 17 x 17 taxels under a layer of silicone read three stresses each; a finite-element program has made these readings.
# What pressed on the skin, dragged along it and turned on it comes back, each with its deviation.

# %%
import matplotlib.pyplot as plt
import numpy as np

import tactile_net as tn

skin = tn.Skin.load("scenes/recorded/skin-pad.toml")
recording = skin.read("scenes/recorded/skin-pad.csv")
print(skin)
print(f"readings {recording.readings.shape}: frames, rows, columns, channels")

# %%
solution = skin.solve(recording)
for k, verdict in enumerate(solution.verdict):
    force = ", ".join(f"{1e3 * f:4.0f}" for f in solution.wrench[k, :3])
    centre = ", ".join(f"{1e3 * c:5.2f}" for c in solution.centre[k])
    torsion = f"{1e6 * solution.torsion[k]:4.0f} +- {1e6 * solution.torsion_deviation[k]:.0f}"
    print(f"frame {k}: {force} mN into, along y, along z; at ({centre}) mm; torsion {torsion} uN m; {verdict}")

# %% [markdown]
# The frames as seen from outside: colours are the pressure, arrows the drag, lines go around the cells that touch. The
# fourth frame is twisted: its arrows run around its middle.

# %%
figure, axes = plt.subplots(2, 3, figsize=(12, 7.5), layout="constrained")
largest = np.nanmax(solution.normal)
for k, ax in enumerate(axes.flat[:5]):
    tn.plot.pressure_map(skin, solution.tractions[k], solution.touching[k], ax=ax, largest=largest)
    ax.set_title(f"frame {k}: {solution.normal_force[k]:.3f} N", loc="left")
tn.plot.over_time(solution, axes.flat[5])
figure.savefig("skin.png", dpi=110)

# %% [markdown]
# For a loop that runs often, one alpha and no constraints make the answer one matrix, (3 x cells) by readings.

# %%
solver = skin.replace({"reconstruct": {"alpha": solution.alpha[0]}}).solver()
print(f"one matrix of {solver.matrix.shape}")
off = solver(recording.readings[0])[0].sum() * skin.cell_area - solution.normal_force[0]
print(f"without constraints all cells together press {1e3 * off:+.0f} mN more")

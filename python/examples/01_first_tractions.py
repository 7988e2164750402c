# %% [markdown]
# # First tractions: from a CSV to a picture
#
# A recording is a file with a frame a row; what must be known of the sensor is a scene. Both may be yours.

# %%
from pathlib import Path

import matplotlib.pyplot as plt

import tactile_net as tn

recorded = Path("scenes/recorded")
scene = tn.Scene.load(recorded / "thin-pad.toml")
recording = scene.read(recorded / "thin-pad.csv")
print(scene)
print(recording, *recording.notes, sep="\n")

# %% [markdown]
# Every frame is solved, with a verdict on the answer, one on the readings, and a band.

# %%
solution = recording.solve()
print(solution, *solution.notes, sep="\n")
for k, force in enumerate(solution.normal_force):
    deviation, centre = solution.normal_force_deviation[k], 1e3 * solution.centre[k]
    print(f"frame {k}: {force:6.1f} +- {deviation:.1f} N/m at {centre:.2f} mm, {solution.verdict[k]}")

# %%
figure, (above, below) = plt.subplots(2, figsize=(8, 7), layout="constrained")
tn.plot.tractions(solution, ax=above)
tn.plot.over_time(solution, ax=below)
figure.savefig("first-tractions.png")

# %% [markdown]
# The same as a page of its own, with a slider over the frames: open first-tractions/report.html.

# %%
solution.report("first-tractions", force=True)

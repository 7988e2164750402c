# %% [markdown]
# # From a robot's log to tractions over time
#
# A finger of a robot presses and slides while its frames go into an MCAP log, as ROS 2 writes them. Then the recorder
# crashes. What is whole of the log has the scene, the units and the times inside: that is all it takes to solve it.

# %%
import warnings
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import tactile_net as tn

moments = [(0.0, 0.0, -4e-3), (0.4, 120.0, -4e-3), (1.0, 120.0, 4e-3), (1.4, 0.0, 4e-3)]
slide = [{"t": t, "force": force, "center": center} for t, force, center in moments]
scene = tn.Scene(
    title="A finger that presses and slides",
    units={},
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x", "shear_xy"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(half_width=2e-3, friction=0.3, trajectory=slide)],
    time=tn.Timing(rate=2000.0, duration=1.4),
    noise=tn.Noise(rms=100.0),
    reconstruct=tn.Reconstruct(alpha=1e-4),
)
tn.logs.write("run.mcap", scene.simulate(), topic="/finger")

# %% [markdown]
# The crash: the last fifth of the file never reached the disk.

# %%
log = Path("run.mcap")
log.write_bytes(log.read_bytes()[: log.stat().st_size * 4 // 5])
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    recording = tn.load(log)
print(told[0].message)
print(f"{recording.scene.title}, {recording}")
assert recording.t is not None
solution = tn.Recording(recording.scene, recording.readings[::20], recording.t[::20]).solve()
print(f"{np.nanmax(solution.normal_force):.0f} N/m at most, solved in {len(solution)} frames")

# %%
figure, (above, below) = plt.subplots(2, 1, figsize=(7, 5), sharex=True, layout="constrained")
tn.plot.over_time(solution, ax=above)
above.set_xlabel("")
below.plot(solution.t, solution.normal_force, label="normal")
below.plot(solution.t, solution.tangential_force, label="tangential")
below.set_xlabel("t [s]")
below.set_ylabel("force [N/m]")
below.legend(frameon=False)
figure.savefig("robot_log.png", dpi=120)

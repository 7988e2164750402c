# %% [markdown]
# # A 1 kHz loop against a plan
#
# All that is slow happens once, in the plan. A frame is then one call: less than a microsecond, nothing is allocated.

# %%
import time

import numpy as np

import tactile_net as tn

scene = tn.Scene(
    sensor=tn.Sensor(count=81, pitch=0.25e-3, depth=1.5e-3, reads=["stress_x", "shear_xy"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[
        tn.Cylinder(
            half_width=2e-3,
            trajectory=[{"t": 0.0, "force": 0.0, "friction": 0.0}, {"t": 0.5, "force": 50.0, "friction": 0.6}],
        )
    ],
    time=tn.Timing(rate=1000.0, duration=0.5),
    noise=tn.Noise(rms={"stress_x": 5.0, "shear_xy": 5.0}),
    reconstruct=tn.Reconstruct(alpha=1e-3),
)
plan = scene.plan(accuracy=1e-6, friction=0.5)
plan.save("pad.plan")  # a controller in C++ loads this file
print(plan)

# %% [markdown]
# `readings` and `tractions` are the estimator's own memory: a driver writes into the one, `step` fills the other.

# %%
recorded = scene.simulate().readings
estimator = tn.Estimator(plan)
slipped, late, longest = None, 0, 0.0
begin = time.perf_counter()
for k, frame in enumerate(recorded):
    while time.perf_counter() < begin + 1e-3 * k:  # stands for a sensor that delivers
        pass
    now = time.perf_counter()
    estimator.readings[:] = frame
    estimator.step()
    contact = estimator.contact
    longest = max(longest, time.perf_counter() - now)
    if slipped is None and contact.contact and contact.normal_force > 5.0 and contact.friction_margin < 0.0:
        slipped = k
print(f"the margin was gone after {slipped} ms; the longest of {len(recorded)} frames took {1e6 * longest:.0f} us")
assert slipped is not None and np.isfinite(estimator.tractions).all()

# %% [markdown]
# Recorded frames go all at once, without the GIL.

# %%
tractions = estimator.update_batch(recorded)
print(f"in a batch: {tractions.shape}, the last as by itself: {np.array_equal(tractions[-1], estimator.tractions)}")

# %% [markdown]
# # Choosing alpha
#
# alpha weighs smoothness against the readings: too small, and the answer is noise; too large, and it is flat. Where
# the truth is known, the best can be seen, and how near the rules come that do not know it.

# %%
import matplotlib.pyplot as plt
import numpy as np

import tactile_net as tn

scene = tn.Scene(
    sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
    contacts=[tn.Cylinder(force=100.0, half_width=2e-3, center=1e-3)],
    noise=tn.Noise(rms=20.0),
)
recording = scene.simulate()
assert recording.truth is not None
truth = recording.truth[0]


def error(tractions: np.ndarray) -> float:
    return float(np.linalg.norm(tractions - truth) / np.linalg.norm(truth))


# %%
alphas = np.geomspace(1e-8, 1e-1, 60)
errors = [error(scene.solver(alpha=alpha)(recording.readings)[0]) for alpha in alphas]
best = alphas[np.argmin(errors)]
print(f"best, if the truth were known: alpha {best:.1e}, error {min(errors):.3f}")

# %% [markdown]
# A rule chooses on the readings alone. All of them side by side, with their verdicts:

# %%
figure, ax = plt.subplots(figsize=(8, 4), layout="constrained")
ax.loglog(alphas, errors, color="0.4")
for rule in ("rgcv", "gml", "aicc", "evidence", "discrepancy", "ncp"):
    answer = tn.run(scene.replace({"reconstruct.alpha": rule}))["tikhonov"]
    print(f"{rule:12} alpha {answer.alpha:.1e}, error {error(answer.normal):.3f}, {answer.verdict}")
    ax.plot([answer.alpha or np.nan], [error(answer.normal)], "o", label=rule)
ax.set_xlabel("alpha")
ax.set_ylabel("|f - truth| / |truth|")
ax.legend(frameon=False)
figure.savefig("choosing-alpha.png")

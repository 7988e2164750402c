# %% [markdown]
# # A circuit, from Python to ngspice
#
# The same least squares as voltages of a network of resistors and op-amps. First what can be said before it is built.

# %%
import shutil
import subprocess
from pathlib import Path

import tactile_net as tn

scene = tn.Scene.load("scenes/circuits/least-squares.toml")
for realization in ("lattice", "least_squares", "crossbar", "nic"):
    certification = scene.certify(realization)
    margin = certification.tolerance_margin
    print(
        f"{realization}: {certification.stability}, proven to bear errors of its parts up to",
        "none" if margin is None else f"{100 * margin:.2g} %",
    )

# %% [markdown]
# Its deck is plain SPICE, and says which voltages to expect.

# %%
deck = Path("least-squares.cir")
deck.write_text(scene.netlist("least_squares"))
print(*deck.read_text().splitlines()[:4], sep="\n")
if shutil.which("ngspice"):
    printed = subprocess.run(["ngspice", "-b", str(deck)], capture_output=True, text=True, check=True).stdout
    print(*[line for line in printed.splitlines() if line.startswith(("n0 ", "v(n0"))], sep="\n")

# %% [markdown]
# `run` does this for every scene that names the method `network`, and compares with the direct solve.

# %%
result = tn.run(scene.replace({"reconstruct.methods": ["tikhonov", "network"]}))
for name, answer in result.methods.items():
    print(f"{name}: {answer.verdict}, {answer.force:.4g} N/m", *answer.remarks, sep="\n  ")

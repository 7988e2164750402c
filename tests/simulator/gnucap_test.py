"""A second simulator, gnucap, finds what the decks of `gen` expect.

usage: gnucap_test.py COMMAND SCENE SCENE_OF_A_LADDER
"""

import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

# A nullor is a gain of 1e21, and gnucap's digits end before that: op-amps have the scene's gain.
REALISATIONS = ["ideal", "nic", "rail", "crossbar", "least_squares", "lattice"]


def voltages(deck, nodes):
    lines = deck.splitlines()
    cards = lines[: lines.index(".end") + 1]
    at = cards.index(".op")
    cards.insert(at, ".print op " + " ".join(f"v({node})" for node in nodes))
    cards.insert(at, ".options numdgt=12 reltol=1e-9 vntol=1e-12 abstol=1e-15")
    with tempfile.NamedTemporaryFile("w", suffix=".cir") as file:
        file.write("\n".join(cards) + "\n")
        file.flush()
        done = subprocess.run(["gnucap", "-b", file.name], capture_output=True, text=True, timeout=60)
    lines = done.stdout.splitlines()
    head = next(k for k, line in enumerate(lines) if line.startswith("#"))
    return [float(word) for word in lines[head + 1].split()[1:]], done.stdout


def main(command, scene, ladder):
    if shutil.which("gnucap") is None:
        print("skipped: apt-get install gnucap gnucap-default-plugins0")
        return 0
    for realisation, of in [(realisation, scene) for realisation in REALISATIONS] + [("least_squares", ladder)]:
        deck = subprocess.run(
            [command, "gen", of, "--realization", realisation], check=True, capture_output=True, text=True
        ).stdout
        expected = {}
        for line in deck.splitlines():
            if line.startswith("* expect "):
                expected[line.split()[2]] = float(line.split()[3])
        found, output = voltages(deck, list(expected))
        assert len(found) == len(expected), output
        off = math.dist(found, expected.values()) / math.hypot(*expected.values())
        print(f"{realisation} of {pathlib.Path(of).stem}: {len(found)} nodes, {off:.1e} off the direct solve")
        assert off < 5e-5, (realisation, off)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

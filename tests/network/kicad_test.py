"""KiCad's own Python loads the board that `certify --budget` writes, finds the deck's nets on its pads, and its design rules kept.

usage: kicad_test.py COMMAND PYTHON SCENE
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

PADS = """
import json, sys
import pcbnew
board = pcbnew.LoadBoard(sys.argv[1])
pads = [[f.GetReference(), p.GetNumber(), p.GetNetname()] for f in board.GetFootprints() for p in f.Pads()]
silent = [f.GetReference() for f in board.GetFootprints() if not f.Reference().IsVisible() or len(list(f.GraphicalItems())) == 0]
violations = None
if hasattr(pcbnew, "WriteDRCReport"):
    pcbnew.WriteDRCReport(board, sys.argv[2], pcbnew.EDA_UNITS_MILLIMETRES, True)
    # What is not joined yet is no violation: nothing is routed.
    violations = [line for line in open(sys.argv[2]) if line.startswith("[") and not line.startswith("[unconnected_items]")]
print(json.dumps({"nets": board.GetNetCount(), "pads": pads, "silent": silent, "violations": violations}))
"""


def nets_of(deck):
    """Ends of every resistor of a deck without sub-circuits of its own but amplifiers."""
    ends = {}
    inside = False
    for line in deck.splitlines()[1:]:
        words = line.split(";")[0].split()
        if not words or line.startswith("*"):
            continue
        if words[0] in (".subckt", ".ends"):
            inside = words[0] == ".subckt"
        elif not inside and words[0][0] == "R":
            ends[words[0]] = tuple("GND" if node == "0" else node for node in words[1:3])
    return ends


def main(command, python, scene):
    if subprocess.run([python, "-c", "import pcbnew"], capture_output=True).returncode != 0:
        print("skipped: apt-get install kicad, whose Python module is pcbnew")
        return 0
    import json

    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        run = lambda *words: subprocess.run([command, *words], check=True, capture_output=True, text=True).stdout
        run("certify", scene, "--budget", "1%", "--out", str(out))
        certificate = json.loads((out / "certificate.json").read_text())
        chosen = certificate["parts"]["choice"]
        # gen writes the same parts of a scene that states the siemens that the board asked for.
        used = pathlib.Path(folder) / "scene.toml"
        text = pathlib.Path(scene).read_text()
        assert text.count("\n[network]\n") == 1 and "\nsiemens" not in text
        used.write_text(text.replace("\n[network]\n", f"\n[network]\nsiemens = {certificate['board']['used']['siemens']!r}\n"))
        expected = nets_of(run("gen", str(used), "--budget", "1%", "--realization", chosen))
        text = subprocess.run(
            [python, "-c", PADS, str(out / "board.kicad_pcb"), str(out / "rules.txt")], check=True, capture_output=True, text=True
        ).stdout
        found = json.loads(text.splitlines()[-1])
        assert not found["silent"], found["silent"]
        assert not found["violations"], found["violations"][:5]
        with open(out / "BOM.csv", newline="") as file:
            element = {row["Designator"]: row["Element"] for row in csv.DictReader(file)}
        on_board = {reference for reference, _, _ in found["pads"] if not reference.startswith("J")}
        assert on_board == set(element), on_board ^ set(element)
        pads = {}
        for reference, number, net in found["pads"]:
            pads.setdefault(element.get(reference, reference), {})[number] = net
        assert expected, "the deck has no resistors"
        for name, (first, second) in expected.items():
            assert pads[name] == {"1": first, "2": second}, (name, pads.get(name), first, second)
        resistors = [name for name in element if name.startswith("R")]
        assert len(resistors) == len(expected), (len(resistors), len(expected))
        names = {net for one in pads.values() for net in one.values()}
        assert found["nets"] == len(names | {""}), (found["nets"], len(names))
        print(f"{len(expected)} resistors, {found['nets']} nets of {chosen}: as in the deck")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

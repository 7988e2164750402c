"""KiCad's own Python loads the boards that `certify --budget` writes: the deck's nets are on their pads, KiCad's design rules are kept,
nothing is left to join, and the schematic has the same nets.

usage: kicad_test.py COMMAND PYTHON CROSSBAR BOARD
CROSSBAR and BOARD: scenes of `crossbar` without siemens, and of a circuit to order, which is tried with eleven taxels.
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

PADS = """
import json, sys
import pcbnew
board = pcbnew.LoadBoard(sys.argv[1])
# Planes are areas of a net: KiCad fills them.
pcbnew.ZONE_FILLER(board).Fill(board.Zones())
pads = [[f.GetReference(), p.GetNumber(), p.GetNetname()] for f in board.GetFootprints() for p in f.Pads()]
silent = [f.GetReference() for f in board.GetFootprints() if not f.Reference().IsVisible() or len(list(f.GraphicalItems())) == 0]
def said(path):
    violations = None
    if hasattr(pcbnew, "WriteDRCReport"):
        pcbnew.WriteDRCReport(board, path, pcbnew.EDA_UNITS_MILLIMETRES, True)
        violations = [line for line in open(path) if line.startswith("[")]
    return violations
violations = said(sys.argv[2])
tracks = [t for t in board.GetTracks() if t.Type() == pcbnew.PCB_TRACE_T]
longest = max(tracks, key=lambda t: t.GetLength())
board.RemoveNative(longest)
print(json.dumps({"nets": board.GetNetCount(), "pads": pads, "silent": silent, "tracks": len(tracks), "violations": violations, "without": said(sys.argv[2])}))
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


def lists(text):
    """KiCad's lists in brackets as Python's."""
    open_lists = [[]]
    for token in re.findall(r'"(?:\\.|[^"\\])*"|[()]|[^\s()]+', text):
        if token == "(":
            open_lists.append([])
        elif token == ")":
            done = open_lists.pop()
            open_lists[-1].append(done)
        else:
            open_lists[-1].append(re.sub(r"\\(.)", r"\1", token[1:-1]) if token[0] == '"' else token)
    return open_lists[0][0]


def every(parent, name):
    return [one for one in parent if isinstance(one, list) and one[0] == name]


def the(parent, name):
    (one,) = every(parent, name)
    return one[1:]


def place_of(one):
    x, y = (round(1e4 * float(number)) for number in the(one, "at")[:2])
    return x, y


def schematic_nets(folder):
    """The net of every pin that the schematic draws, by designator: labels and pins that meet are one."""
    root = lists((folder / "board.kicad_sch").read_text())
    references = {path[1]: the(path, "reference")[0] for path in every(the(root, "symbol_instances"), "path")}
    sheets = [("/", root)]
    for sheet in every(root, "sheet"):
        (file,) = [one[2] for one in every(sheet, "property") if one[1] == "Sheet file"]
        sheets.append((f"/{the(sheet, 'uuid')[0]}/", lists((folder / file).read_text())))
    drawn = {}
    for path, sheet in sheets:
        net_at = {place_of(one): one[1] for one in every(sheet, "global_label")}
        net_at.update({place_of(one): "" for one in every(sheet, "no_connect")})
        symbols = {one[1]: [pin for unit in every(one, "symbol") for pin in every(unit, "pin")] for one in every(the(sheet, "lib_symbols"), "symbol")}
        for symbol in every(sheet, "symbol"):
            reference = references.pop(path + the(symbol, "uuid")[0])
            at = place_of(symbol)
            pins = {}
            for pin in symbols[the(symbol, "lib_id")[0]]:
                x, y = place_of(pin)
                pins[the(pin, "number")[0]] = net_at[at[0] + x, at[1] - y]
            drawn[reference] = pins
    assert not references, references
    return drawn


def check(command, python, text, budget):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = folder / "scene.toml"
        scene.write_text(text)
        out = folder / "out"
        run = lambda *words: subprocess.run([command, *words], check=True, capture_output=True, text=True).stdout
        run("certify", str(scene), "--budget", budget, "--out", str(out))
        chosen = json.loads((out / "certificate.json").read_text())["parts"]["choice"]
        # gen writes the same parts of the scene that states the siemens that the board asked for.
        expected = nets_of(run("gen", str(out / "scene.ordered.toml"), "--budget", budget))
        said = subprocess.run(
            [python, "-c", PADS, str(out / "board.kicad_pcb"), str(out / "rules.txt")], check=True, capture_output=True, text=True
        ).stdout
        found = json.loads(said.splitlines()[-1])
        assert not found["silent"], found["silent"]
        assert not found["violations"], found["violations"][:5]
        assert found["without"] is None or found["without"], "a missing track is not seen"
        with open(out / "BOM.csv", newline="") as file:
            element = {row["Designator"]: row["Element"] for row in csv.DictReader(file)}
        on_board = {reference for reference, _, _ in found["pads"] if not re.match("J|TP|H", reference)}
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
        drawn = schematic_nets(out)
        of_board = {}
        for reference, number, net in found["pads"]:
            of_board.setdefault(reference, {})[number] = net
        assert drawn == of_board, {name for name in drawn.keys() | of_board.keys() if drawn.get(name) != of_board.get(name)}
        print(f"{chosen}: {len(expected)} resistors, {found['nets']} nets as in the deck, {found['tracks']} tracks, nothing missing")


def main(command, python, crossbar, board):
    if subprocess.run([python, "-c", "import pcbnew"], capture_output=True).returncode != 0:
        print("skipped: apt-get install kicad, whose Python module is pcbnew")
        return 0
    check(command, python, pathlib.Path(crossbar).read_text(), "1%")
    eleven = pathlib.Path(board).read_text().replace("\ncount = 41\npitch = 0.25\n", "\ncount = 11\npitch = 0.5\n")
    assert "\ncount = 11\n" in eleven
    check(command, python, eleven, "0.5%")
    # A package with finer pins.
    part = 'opamp = { part = "THS4551", gain = 1e5, second_pole = 270e6, noise_current = 5e-13 }'
    finer = re.sub("opamp = .*", part, eleven).replace('realization = "lattice"', 'realization = "crossbar"')
    check(command, python, finer, "1%")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

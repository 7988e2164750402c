"""KiCad's own Python loads the boards that `certify --budget` writes: the deck's nets are on their pads, KiCad's design rules are kept,
nothing is left to join, and the schematic has the same nets. The script that is written beside a board makes its files for a maker.

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
import zipfile

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
placed = pcbnew.PLACE_FILE_EXPORTER(board, True, False, False, True, True, True, False).GenPositionData()
print(json.dumps({"placed": placed, "nets": board.GetNetCount(), "pads": pads, "silent": silent, "tracks": len(tracks), "violations": violations, "without": said(sys.argv[2])}))
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
    return {reference: pins for reference, pins in drawn.items() if not reference.startswith("#")}


def holes_of(file):
    """The places of an Excellon file's holes, by their diameter."""
    diameters, holes, tool = {}, {}, None
    for line in file.read_text().splitlines():
        if match := re.fullmatch(r"(T\d+)C([\d.]+)", line):
            diameters[match[1]] = float(match[2])
        elif re.fullmatch(r"T\d+", line) and line in diameters:
            tool = diameters[line]
        elif match := re.fullmatch(r"X([-\d.]+)Y([-\d.]+)", line):
            holes.setdefault(tool, []).append((round(float(match[1]), 3), round(-float(match[2]), 3)))
    return {diameter: sorted(places) for diameter, places in holes.items()}


def turned(x, y, angle):
    for _ in range(round(angle / 90.0) % 4):
        x, y = y, -x
    return x, y


def wanted_holes(board):
    """The same of the board's own file: vias, pins of headers and holes for screws."""
    holes = {}
    for via in every(board, "via"):
        x, y = (float(number) for number in the(via, "at"))
        holes.setdefault(float(the(via, "drill")[0]), []).append((round(x, 3), round(y, 3)))
    for footprint in every(board, "footprint"):
        x, y, angle = (float(number) for number in (*the(footprint, "at"), 0)[:3])
        for pad in every(footprint, "pad"):
            if not every(pad, "drill"):
                continue
            dx, dy = turned(*(float(number) for number in the(pad, "at")[:2]), angle)
            holes.setdefault(float(the(pad, "drill")[0]), []).append((round(x + dx, 3), round(y + dy, 3)))
    return {diameter: sorted(places) for diameter, places in holes.items()}


def check_fabrication(python, out, placed):
    """What a maker and an assembler get."""
    script = [python, str(out / "fabricate.py")]
    board = lists((out / "board.kicad_pcb").read_text())
    subprocess.run(script, check=True, capture_output=True, text=True)
    made = out / "fabrication"
    layers = ["F_Cu", "In1_Cu", "In2_Cu", "B_Cu", "F_Paste", "F_Mask", "B_Mask", "F_Silkscreen", "Edge_Cuts"]
    files = {f"board-{layer}.gbr" for layer in layers} | {"board-PTH.drl", "board-NPTH.drl"}
    with zipfile.ZipFile(made / "board-gerbers.zip") as packed:
        assert set(packed.namelist()) == files, packed.namelist()
        for name in files:
            assert packed.read(name) == (made / name).read_bytes()
    # A flash for each pad and via, copper all over the planes, and the outline.
    flashes = lambda layer: len(re.findall(r"D03\*", (made / f"board-{layer}.gbr").read_text()))
    vias = len(every(board, "via"))
    pads = sum(len(every(footprint, "pad")) for footprint in every(board, "footprint")) - 4
    assert flashes("F_Cu") == pads + vias, (flashes("F_Cu"), pads, vias)
    for layer, net in (("In1_Cu", "GND"), ("In2_Cu", "VCC")):
        text = (made / f"board-{layer}.gbr").read_text()
        assert "G36*" in text and f"TO.N,{net}*" in text, layer
    places = re.findall(r"X(\d+)Y(-\d+)D0", (made / "board-Edge_Cuts.gbr").read_text())
    (outline,) = every(board, "gr_rect")
    corner = [round(1e6 * float(number)) for number in the(outline, "end")]
    assert [max(int(x) for x, _ in places), -min(int(y) for _, y in places)] == corner, (places, corner)
    holes = {}
    for name in ("PTH", "NPTH"):
        for diameter, at in holes_of(made / f"board-{name}.drl").items():
            holes.setdefault(diameter, []).extend(at)
    assert {diameter: sorted(at) for diameter, at in holes.items()} == wanted_holes(board)
    # Parts stand where KiCad's own file of positions has them.
    with open(out / "board.pos.csv", newline="") as file:
        rows = {row["Designator"]: row for row in csv.DictReader(file)}
    own = {row["Ref"]: row for row in csv.DictReader(placed.splitlines())}
    assert rows.keys() == own.keys(), rows.keys() ^ own.keys()
    for reference, row in rows.items():
        of_kicad = own[reference]
        assert (row["Val"], row["Package"], row["Layer"]) == (of_kicad["Val"], of_kicad["Package"], of_kicad["Side"])
        for mine, kicads in (("Mid X", "PosX"), ("Mid Y", "PosY")):
            assert abs(float(row[mine]) - float(of_kicad[kicads])) < 1e-3, (reference, row, of_kicad)
        assert (float(row["Rotation"]) - float(of_kicad["Rot"])) % 360.0 == 0.0, (reference, row, of_kicad)
    # A board without one of its tracks is refused, and nothing is written.
    with tempfile.TemporaryDirectory() as name:
        text = (out / "board.kicad_pcb").read_text()
        broken = pathlib.Path(name) / "board.kicad_pcb"
        broken.write_text(re.sub(r"  \(segment .*\n", "", text, count=1))
        (broken.parent / "board.kicad_pro").write_text((out / "board.kicad_pro").read_text())
        refused = subprocess.run([*script, str(broken)], capture_output=True, text=True)
        assert refused.returncode != 0 and "nothing is written" in refused.stderr, refused
        assert not (broken.parent / "fabrication").exists()


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
        on_board = {reference for reference, _, _ in found["pads"] if not re.match("TP|H", reference)}
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
        check_fabrication(python, out, found["placed"])
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

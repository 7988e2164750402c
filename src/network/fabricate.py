"""Fills the planes of board.kicad_pcb, checks the board by KiCad's rules and writes what a maker takes.

usage: python3 fabricate.py [BOARD.kicad_pcb [FOLDER]]
BOARD: board.kicad_pcb beside this file if none is named. FOLDER: "fabrication" beside the board; new or empty, or an earlier run's.
KiCad 6 or newer; the Python that has its module pcbnew: of Debian and Ubuntu /usr/bin/python3, elsewhere that of KiCad's folder.
FOLDER has a Gerber file (X2) of each layer, the holes as Excellon files, and all of them as BOARD-gerbers.zip, to be sent to a maker.
Nothing is written if KiCad finds a rule broken or a net that is not joined. The board's file is not changed.
"""

import pathlib
import shutil
import sys
import tempfile
import zipfile

LAYERS = {
    "F.Cu": "tracks and parts",
    "In1.Cu": "plane of GND",
    "In2.Cu": "plane of VCC",
    "B.Cu": "tracks",
    "F.Paste": "solder paste, for the stencil",
    "F.Mask": "solder mask",
    "B.Mask": "solder mask",
    "F.Silkscreen": "names",
    "Edge.Cuts": "the board's outline",
}


def broken_rules(pcbnew, board):
    """Lines of KiCad's own check; none where this KiCad has no such call."""
    if not hasattr(pcbnew, "WriteDRCReport"):
        print("this KiCad's Python has no check of rules: run Inspect, Design Rules Checker")
        return []
    unit = getattr(pcbnew, "EDA_UNITS_MILLIMETRES", None)
    unit = getattr(pcbnew, "EDA_UNITS_MM", 1) if unit is None else unit
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "rules.txt"
        pcbnew.WriteDRCReport(board, str(report), unit, True)
        return [line.strip() for line in report.read_text().splitlines() if line.startswith("[")]


def plot(pcbnew, board, folder):
    control = pcbnew.PLOT_CONTROLLER(board)
    options = control.GetPlotOptions()
    options.SetOutputDirectory(str(folder))
    options.SetPlotFrameRef(False)
    options.SetUseGerberProtelExtensions(False)
    options.SetUseGerberX2format(True)
    options.SetIncludeGerberNetlistInfo(True)
    options.SetCreateGerberJobFile(False)
    options.SetSubtractMaskFromSilk(True)
    options.SetUseAuxOrigin(False)
    options.SetDrillMarksType(getattr(pcbnew, "DRILL_MARKS_NO_DRILL_SHAPE", 0))
    for layer, purpose in LAYERS.items():
        number = board.GetLayerID(layer)
        if number < 0:
            raise SystemExit(f"the board has no layer {layer}")
        control.SetLayer(number)
        control.OpenPlotfile(layer.replace(".", "_"), pcbnew.PLOT_FORMAT_GERBER, purpose)
        if not control.PlotLayer():
            raise SystemExit(f"KiCad does not plot the layer {layer}")
    control.ClosePlot()


def drill(pcbnew, board, folder):
    writer = pcbnew.EXCELLON_WRITER(board)
    writer.SetFormat(True)  # millimetres
    # Holes with copper and without apart, from the same corner as the Gerbers.
    corner = type(board.GetDesignSettings().GetAuxOrigin())(0, 0)
    writer.SetOptions(False, False, corner, False)
    writer.CreateDrillandMapFilesSet(str(folder), True, False)


def main(path=None, folder=None):
    path = pathlib.Path(path) if path else pathlib.Path(__file__).parent / "board.kicad_pcb"
    folder = pathlib.Path(folder) if folder else path.parent / "fabrication"
    try:
        import pcbnew
    except ImportError:
        raise SystemExit("this Python has no module pcbnew: install KiCad 6 or newer, and run the Python that it belongs to")
    if not path.is_file():
        raise SystemExit(f"{path}: no such board")
    archive = folder / f"{path.stem}-gerbers.zip"
    if folder.exists() and any(folder.iterdir()) and not archive.exists():
        raise SystemExit(f"{folder} has other files: name a folder that is new or empty")
    board = pcbnew.LoadBoard(str(path))
    pcbnew.ZONE_FILLER(board).Fill(board.Zones())
    broken = broken_rules(pcbnew, board)
    if broken:
        print(*broken[:20], sep="\n")
        raise SystemExit(f"{path}: {len(broken)} broken rules or missing tracks: mend them in KiCad; nothing is written")
    with tempfile.TemporaryDirectory() as written:
        plot(pcbnew, board, written)
        drill(pcbnew, board, written)
        files = sorted(one for one in pathlib.Path(written).iterdir() if one.suffix in (".gbr", ".drl"))
        folder.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
            for one in files:
                packed.write(one, one.name)
                shutil.copy(one, folder)
    print(f"no rule is broken and every net is joined; {archive} has {len(files)} files for the maker")


if __name__ == "__main__":
    main(*sys.argv[1:])

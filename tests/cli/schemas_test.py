"""What the command writes as JSON is what `schema` says of every kind, and nothing near it is.

usage: schemas_test.py TACTILE-NET SCENES [long]
With `long`: of the two documents that take longest to make.
"""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("skipped: tools/install-dependencies python3-jsonschema")
    sys.exit(77)

tool, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
is_long = sys.argv[3:] == ["long"]
failures = []


def printed(*arguments):
    return subprocess.run([tool, *arguments], capture_output=True, text=True, check=True).stdout


def validator(kind):
    schema = json.loads(printed("schema", kind))
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


validators = {line.split()[0]: validator(line.split()[0]) for line in printed("schema").splitlines()}


def written(*arguments, status=0):
    """The JSON that a command writes."""
    run = subprocess.run([tool, *map(str, arguments), "--json", "-"], capture_output=True, text=True)
    if run.returncode != status:
        failures.append(f"{arguments}: exit status {run.returncode}: {run.stderr}")
        return None
    return run.stdout


def objects(value):
    """Every object of a document."""
    if isinstance(value, dict):
        yield value
        value = list(value.values())
    if isinstance(value, list):
        for inner in value:
            yield from objects(inner)


def shortened(value):
    """Lists of two elements show as much as long ones."""
    if isinstance(value, dict):
        return {key: shortened(inner) for key, inner in value.items()}
    return [shortened(inner) for inner in value[:2]] if isinstance(value, list) else value


# Names of what is measured or counted, as keys.
maps = [lambda key: key.startswith(("stress_", "strain_", "shear_")), lambda key: key in verdicts]
verdicts = set()
# What is there only where it means something.
optional = {"frame", "constraints", "failure", "parts", "tangential", "replayed", "replay_difference", "units", "baseline", "iteration", "taxels", "other_base_gain", "answer", "interval", "low", "high", "alpha_quartiles"}


def check_strict(document, valid):
    """A key that is missing or misspelt is found, wherever it stands."""
    document = shortened(document)
    if not valid(document):
        return  # found already, in the document itself
    for number in range(sum(1 for _ in objects(document))):
        for key in list(list(objects(document))[number]):
            if any(is_one(key) for is_one in maps):
                continue
            changed = copy.deepcopy(document)
            place = list(objects(changed))[number]
            place[key + "s"] = place.pop(key)
            if valid(changed):
                failures.append(f"{document['kind']}: '{key}s' passes for '{key}'")
            del place[key + "s"]
            if key not in optional and valid(changed):
                failures.append(f"{document['kind']}: nobody misses '{key}'")


def check(kind, text, what, is_strict=False):
    if text is None:
        return
    document = json.loads(text)
    verdicts.update(document.get("verdicts", {}))
    verdicts.update(document.get("distrusted", {}))
    if list(document)[:3] != ["tactile_net", "kind", "schema"] or document["kind"] != kind:
        failures.append(f"{what}: begins with {list(document.items())[:3]}, not as '{kind}'")
        return
    for error in validators[kind].iter_errors(document):
        failures.append(f"{what}: {error.json_path}: {error.message[:300]}")
    for other in validators.keys() - {kind}:
        if validators[other].is_valid(document):
            failures.append(f"{what}: passes for '{other}' too")
    form = (kind, document.get("dimensions"), bool(document.get("grid")))  # of lines and of skins other keys
    if form not in strict or is_strict:
        check_strict(document, validators[kind].is_valid)
    strict.add(form)
    seen.add(kind)


SMALL = """
[sensor]
count = 5
pitch = 1.0
depth = 1.0
reads = ["stress_x"]
[material]
youngs_modulus = 1.0
poisson_ratio = 0.3
[[contact]]
shape = "cylinder"
half_width = 1.0
force = 1.0
[reconstruct]
alpha = 1e-3
"""

seen = set()
strict = set()  # and of a kind with several forms, which ones
recorded = scenes / "recorded"


def check_long(place):
    check("run", written("run", scenes / "effects/everything.toml"), "everything")
    small = place / "small.toml"
    small.write_text(SMALL)
    check("tradeoff", written("tradeoff", small), "tradeoff")


def check_all(place):
    for scene in sorted(scenes.rglob("*.toml")):
        if scene.parent.name not in ("recorded", "hands", "sweeps", "calibration"):
            check("explain", written("run", scene, "--explain"), scene)
    # Of each: another circuit, other effects, two channels, a scene over time, a method without an answer.
    for name in ("nic", "edge-of-array", "dragged", "two-strains", "effects/hysteresis", "effects/sliding",
                 "circuits/rail", "thesis/example-3.2"):
        check("run", written("run", scenes / f"{name}.toml"), name)
    for name in ("sphere", "pressure-pad"):  # three tractions, and one
        check("run", written("run", scenes / "skins" / f"{name}.toml"), name)
    skin = place / "skin.toml"  # with 3 x 3 taxels its circuit takes a fifth of the time
    skin.write_text((scenes / "skins/circuit.toml").read_text().replace("rows = 4", "rows = 3").replace("columns = 4", "columns = 3"))
    check("run", written("run", skin, "--realization", "ideal"), "a skin's circuit")
    for name in ("sphere", "pressure-alone", "palm", "row"):  # all told, half of it, taxels anywhere, in a row
        check("identify", written("identify", scenes / "skins" / f"{name}.toml"), name)
    subprocess.run([tool, "simulate", skin, "-q", "-o", place / "g.csv"], check=True)
    pad = (skin, "--readings", place / "g.csv")
    subprocess.run([tool, "solve", *pad, "-q", "-o", place / "f.csv", "--json", place / "s"], check=True)
    check("solve", (place / "s").read_text(), "a skin's recording")
    for name in ("fingertip", "two-strains", "dragged-two-depths"):
        check("identify", written("identify", scenes / f"{name}.toml"), name)
    for scene in (scenes / "nic.toml", scenes / "circuits/crossbar.toml", scenes / "circuits/least-squares.toml", skin):
        check("certify", written("certify", scene), scene)
    scene = scenes / "circuits/crossbar.toml"
    subprocess.run([tool, "certify", scene, "-q", "--datasheet", "--out", place / "sheet"], check=True, capture_output=True)
    check("datasheet", (place / "sheet/crossbar.datasheet.json").read_text(), scene)
    for scene in (scenes / "nic.toml", scenes / "circuits/rail.toml", skin):
        check("relax", written("relax", scene), scene)
    subprocess.run([tool, "gen", scenes / "nic.toml", "-o", place / "nic.cir"], check=True)
    check("deck", written("relax", place / "nic.cir"), "a deck")
    model = place / "fda.lib"
    model.write_text(".SUBCKT FDA 1 2 3 4 5 6 7\nG1 0 8 1 2 1e-3\nR1 8 0 1e8\nC1 8 0 20e-12\n"
                     "EP 5 0 POLY(2) 8 0 7 0 0 1 1\nEN 6 0 VALUE={V(7)-V(8)}\nI1 3 4 1m\n.ENDS\n")
    bench = scenes / "circuits/bench.toml"
    # Another op-amp than the scene's may settle otherwise: either way it is told.
    text = subprocess.run([tool, "relax", bench, "--model", model, "--json", "-", "-q"], capture_output=True, text=True)
    check("macromodel", text.stdout, "a macromodel")
    check("refinement", written("relax", scenes / "circuits/crossbar.toml", "--refine", "cycles=3"), "a refinement")
    for faults in ((), ("--fault", "swapped:Rk1_2p/Rt3_4n")):
        subprocess.run([tool, "bench", bench, "--simulate", place / "board.csv", *faults], check=True)
        check("bench", written("bench", bench, place / "board.csv", status=1 if faults else 0), "a board")
    for name in ("fingertip", "effects/sliding", "skins/row"):
        subprocess.run([tool, "simulate", scenes / f"{name}.toml", "-q", "-o", place / "g.csv", "--json", place / "s"],
                       check=True)
        check("simulate", (place / "s").read_text(), name)
    pad = (recorded / "thin-pad.toml", "--readings", recorded / "thin-pad.csv")
    for missing in ("fail", "estimate"):
        subprocess.run([tool, "solve", *pad, "-q", "--missing", missing, "-o", place / "f.csv", "--json", place / "s"],
                       check=True)
        check("solve", (place / "s").read_text(), missing, missing == "fail")  # of a line
    counts = (recorded / "thin-pad-counts.toml", "--readings", recorded / "thin-pad-counts.csv")  # with [units]
    subprocess.run([tool, "solve", *counts, "-q", "-o", place / "f.csv", "--json", place / "s"], check=True)
    check("solve", (place / "s").read_text(), "counts")
    # Something wrong of several kinds: a dead taxel, a gap, times that run backwards.
    rows = (recorded / "thin-pad.csv").read_text().splitlines()
    for row, change in ((3, {1: "nan"}), (4, {0: "0"})):
        cells = rows[row].split(",")
        for column, value in change.items():
            cells[column] = value
        rows[row] = ",".join(cells)
    rows[1:] = [",".join(["0" if column == 5 else cell for column, cell in enumerate(row.split(","))]) for row in rows[1:]]
    (place / "bad.csv").write_text("\n".join(rows) + "\n")
    check("check", written("check", pad[0], "--readings", place / "bad.csv", "-q"), "a recording with gaps")
    check("check", written("check", *counts, "-q"), "counts")
    check("check", written("check", recorded / "skin-pad.toml", "--readings", recorded / "skin-pad.csv", "-q"), "a skin")
    for name in ("skin-pad", "thin-pad-counts"):
        files = (recorded / f"{name}.csv", "--scene", recorded / f"{name}.toml", "-q")
        check("report", written("report", *files), f"recordings of {name}")
    log = scenes / "calibration" / "no-loads"
    check("calibrate", written("calibrate", log.with_suffix(".csv"), "--scene", log.with_suffix(".toml"), "--next", "2"), "a log")
    log = scenes / "calibration" / "skin-layer"
    check("calibrate", written("calibrate", log.with_suffix(".csv"), "--scene", log.with_suffix(".toml"), "--next", "2"), "a log of a skin")
    check("plan", written("plan", *counts, "-q"), "a plan for counts")
    check("identify", written("identify", *counts), "counts")
    check("plan", written("plan", scenes / "fingertip.toml", "-q"), "a plan")
    for hand in (scenes / "hands" / "two-fingers.toml", scenes / "hands" / "three-fingers.toml", recorded / "hand.toml"):
        check("grasp", written("grasp", hand), hand)
    for hand in ("box.toml", "ball.toml"):
        check("grasp", written("grasp", scenes / "hands" / hand), hand)
    slippery = place / "slippery.toml"
    slippery.write_text((scenes / "hands" / "ball.toml").read_text()
                        .replace("friction = 0.6", "friction = 0.2").replace("-1.5]", "1.5]"))
    check("grasp", written("grasp", slippery, status=1), "a ball that nothing holds")
    check("tradeoff", written("tradeoff", skin, "--digital"), "of a skin")
    small = place / "small.toml"
    small.write_text(SMALL)
    study = place / "study.toml"
    study.write_text('scene = "small.toml"\nrepeats = 2\nkeep = ["error", "tractions"]\n'
                     '[[axis]]\nkey = "sensor.depth"\nvalues = [1, 2]\n'
                     '[[axis]]\nkey = "material.poisson_ratio"\nvalues = [0.3, 0.7]\n')
    check("sweep", written("sweep", study, "-q", "-o", place / "swept.csv"), "half of a study fails")
    small.write_text("[units]\n" + small.read_text())
    check("sweep", written("sweep", study, "-q", "-o", place / "units.csv"), "in SI")
    check("sweep", written("merge", place / "units.csv", "-q"), "merged")


with tempfile.TemporaryDirectory() as place:
    (check_long if is_long else check_all)(pathlib.Path(place))
if validators.keys() != seen and not is_long:
    failures.append(f"schemas of {set(validators)}, documents of {seen}")
print("\n".join(failures) if failures else f"{len(seen)} kinds")
sys.exit(1 if failures else 0)

#!/usr/bin/env python3
"""A number that is added in one line is in every output: new_number_test.py PROJECT

In a copy of the project with its build folder one field is added to what a contact amounts to. The command and the Python
module are built again; JSON, its schema, CSV, the terminal's tables, the pages, the docs' table and Python have the number.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

project = pathlib.Path(sys.argv[1]).resolve()
table = "include/tactile_net/lab/answer_fields.hpp"
behind = "struct Fields<UncertainWrench> {\n  using W = UncertainWrench;\n  static constexpr auto all = std::tuple{\n"
line = """      field(
          "probe", [](const W&) { return std::optional(Uncertain{0.125, 0.0625}); }, "A number that was added."),
"""
scene = "scenes/skins/pressure-pad.toml"  # three contacts


def run(*command, folder):
    done = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}:\n{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


def expect(what, found):
    print(("has it: " if found else "DOES NOT HAVE IT: ") + what)
    return found


with tempfile.TemporaryDirectory() as place:
    copy = pathlib.Path(place, "project")
    files = run("git", "ls-files", "-co", "--exclude-standard", folder=project).splitlines()
    for name in files:
        if (project / name).is_file():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(project / name, copy / name)
    text = (copy / table).read_text()
    if text.count(behind) != 1:
        sys.exit(f"{table} has changed: say in this test where a field of UncertainWrench is added")
    (copy / table).write_text(text.replace(behind, behind + line))

    python = project / f"build/python/cp{sys.version_info[0]}{sys.version_info[1]}/tools/bin/python"
    with_python = python.exists()
    settings = ["-DTACTILE_NET_TESTS=OFF", "-DTACTILE_NET_EXAMPLES=OFF", "-DTACTILE_NET_BENCH=OFF"]
    if with_python:
        settings += ["-DTACTILE_NET_PYTHON=ON", f"-DPython_EXECUTABLE={python}"]
    run("cmake", "--preset", "release", *settings, folder=copy)
    run("cmake", "--build", "--preset", "release", folder=copy)
    tool = copy / "build/release/tactile-net"

    out = copy / "out"
    terminal = run(tool, "run", scene, "--out", out, "--json", copy / "run.json", folder=copy)
    answer = json.loads((copy / "run.json").read_text())["reconstructions"][0]
    number = {"value": 0.125, "deviation": 0.0625}
    run(tool, "simulate", scene, "-o", copy / "readings.csv", folder=copy)
    run(tool, "solve", scene, "--readings", copy / "readings.csv", "-o", copy / "found.csv", "--uncertainty", copy / "sure.csv",
        "--out", copy / "solved", folder=copy)
    run(sys.executable, "-B", copy / "tests/docs/fields_test.py", tool, copy / "docs/results.md", "--write", folder=copy)
    run(sys.executable, "-B", copy / "tests/docs/fields_test.py", tool, copy / "python/tactile_net/_told.py", "--write", folder=copy)
    page = (out / "report.html").read_text()
    recording = (copy / "solved/report.html").read_text()
    all_have_it = [
        expect("JSON, the whole", answer["resultant"]["probe"] == number),
        expect("JSON, each contact", [one["probe"] for one in answer["patches"]] == [number] * 3),
        expect("the schema of run", '"A number that was added."' in run(tool, "schema", "run", folder=copy)),
        expect("the schema of solve", '"A number that was added."' in run(tool, "schema", "solve", folder=copy)),
        expect("CSV", "probe,probe_deviation" in (copy / "sure.csv").read_text().splitlines()[0]),
        expect("the terminal, the whole", any(row.startswith("probe") for row in terminal.splitlines())),
        expect("the terminal, each contact", any(row.startswith("contact") and "probe" in row for row in terminal.splitlines())),
        expect("the page of run", '<td data-label="probe">' in page),
        expect("the page of a recording", '{"label":"probe"' in recording),
        expect("docs/results.md", "`patches.probe` |  | A number that was added." in (copy / "docs/results.md").read_text()),
        expect("the attributes of Python's contacts", "    probe: Uncertain" in (copy / "python/tactile_net/_told.py").read_text()),
    ]
    if with_python:
        module = next(copy.glob("build/release/python/_core*.so"))
        shutil.copy2(module, copy / "python/tactile_net/")
        clean = project / f"build/python/cp{sys.version_info[0]}{sys.version_info[1]}/clean/bin/python"
        program = f"""
import tactile_net as tn
result = tn.run(tn.Scene.load({scene!r}))
print(result.told.reconstructions[0].resultant.probe, result.skin.patches[0].probe,
      [key.text for key in tn.keys("run") if key.name == "reconstructions.patches.probe"])
"""
        said = subprocess.run([clean, "-B", "-c", program], cwd=copy, env={"PYTHONPATH": str(copy / "python")}, capture_output=True, text=True)
        uncertain = "Uncertain(value=0.125, deviation=0.0625, interval=None)"
        all_have_it.append(expect("Python", said.stdout.strip() == f"{uncertain} {uncertain} ['A number that was added.']"))
        print(said.stderr, end="")
    else:
        print("not looked at: Python; tools/python setup makes its environment")
    sys.exit(0 if all(all_have_it) else 1)

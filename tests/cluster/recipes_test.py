#!/usr/bin/env python3
"""Runs a recipe of docs/sweeps.md as it stands there: recipes_test.py COMMAND PROJECT NAME

Compares its rows with those of one process. Skipped where what it needs is not installed.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

command = pathlib.Path(sys.argv[1]).resolve()
project = pathlib.Path(sys.argv[2])
name = sys.argv[3]

sys.path.append(str(project / "tests/docs"))
from markdown_page import Document  # noqa: E402

PROGRAMS = {"parallel": ["parallel", "--version"], "dask": [sys.executable, "-c", "import dask.distributed, tactile_net"]}


def installed(words):
    if shutil.which(words[0]) is None:
        return False
    return subprocess.run(words, capture_output=True).returncode == 0


def main():
    if not installed(PROGRAMS[name]):
        print(f"skipped: {name} is not installed")
        return
    blocks = Document(project / "docs/sweeps.md").blocks
    recipe = next(block for block in blocks if block.option("recipe") == name)
    study = next(block for block in blocks if block.option("file") == "study.toml")
    with tempfile.TemporaryDirectory(prefix="tactile-net-recipe-") as folder:
        place = pathlib.Path(folder)
        shutil.copytree(project / "scenes/sweeps", place / "scenes/sweeps")
        (place / "study.toml").write_text(study.text, encoding="utf-8")
        environment = {**os.environ, "PATH": f"{command.parent}:{os.environ['PATH']}", "HOME": folder}

        def run(*words):
            answer = subprocess.run(words, cwd=place, env=environment, capture_output=True, text=True, timeout=300)
            if answer.returncode != 0:
                raise SystemExit(f"FAILED: {words}: {answer.stdout}{answer.stderr}")

        run("tactile-net", "sweep", "study.toml", "-o", "serial.csv", "--jobs", "1")
        run("tactile-net", "merge", "serial.csv", "--out", "serial")
        recipe_file = place / "recipe"
        recipe_file.write_text(recipe.text, encoding="utf-8")
        run({"sh": "bash", "python": sys.executable}[recipe.language], str(recipe_file))
        if (place / "out/results.csv").read_bytes() != (place / "serial/results.csv").read_bytes():
            raise SystemExit("FAILED: the rows are not those of one process")
        print(f"{name}: the same rows")


main()

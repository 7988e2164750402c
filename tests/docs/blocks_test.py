#!/usr/bin/env python3
"""Runs the code blocks of one page in a copy of the project: blocks_test.py COMMAND PROJECT PAGE [--write]

The blocks of a page run one after another in the same copy, so that a later one finds the files of an earlier one.

  sh       bash runs it; it must succeed
  console  `$ ` begins a command, what follows is what it prints; exit=N where it is to fail
  toml     parsed; a whole scene goes through `run --explain`, a whole hand through `grasp`; file=NAME writes it there
           for the blocks below, append=NAME adds it
  json     parsed
  python   parsed; tools/python test runs it from the installed package, with what is printed below it in a block ```text
  cpp      compiled elsewhere (CMakeLists.txt)
  text     anything else, not looked at

`no-run` in the info string leaves a block out; the comment above it, <!-- not run: ... -->, says why.

What is printed must be what stands in the page, in its order: `...` alone stands for any lines, at a line's end for the rest
of it. Blanks and letters are compared as they are, numbers to 1 %, for another processor rounds in another way; times, and
numbers below 1e-9, which are rounding, may be any. `--write` puts what is printed now into the page, line by line, where it
differs: read the change before it is kept.
"""

import ast
import difflib
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

from markdown_page import Document

NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
TIME = rf"{NUMBER}(?= ?(?:ns|us|µs|ms|s|minutes?)\b)"


def equal(shown, printed):
    """Whether two lines say the same, up to times, rounding and the width of columns."""
    if shown.endswith("..."):
        shown = shown[:-3].rstrip()
        words = len(shown.split())
        printed = " ".join(printed.split()[:words])
    shown, printed = (re.sub(TIME, "TIME", line) for line in (shown, printed))
    shown, printed = (re.sub(r"TIME ?[nuµm]?s\b", "TIME", line) for line in (shown, printed))
    if re.sub(NUMBER, "0", shown).split() != re.sub(NUMBER, "0", printed).split():
        return False
    pairs = zip(re.findall(NUMBER, shown), re.findall(NUMBER, printed))
    return all(math.isclose(float(a), float(b), rel_tol=0.01, abs_tol=1e-9) for a, b in pairs)


def missing_line(shown, printed):
    """The first line of the page that is not printed where it should be; None where all are."""
    at, free = 0, False
    for line in shown:
        if line.strip() == "...":
            free = True
            continue
        while free and at < len(printed) and not equal(line, printed[at]):
            at += 1
        if at == len(printed) or not equal(line, printed[at]):
            return line
        at, free = at + 1, False
    return None if free or at == len(printed) else "(nothing more)"


def rewritten(shown, printed):
    """The lines of a page as they are printed now: each replaced by the one that resembles it most, the rest of it left out."""
    out, at = [], 0
    for line in shown:
        short = line.endswith("...")
        near = {i: difflib.SequenceMatcher(None, line, printed[i][: len(line)] if short else printed[i]).ratio()
                for i in range(at, len(printed))}
        best = max(near, key=near.get, default=None)
        if line.strip() == "..." or best is None or equal(line, printed[best]) or near[best] < 0.5:
            out.append(line)
        else:
            out.append(" ".join(printed[best].split(" ")[: len(line.split(" ")) - 1]) + " ..." if short else printed[best])
        if line.strip() != "..." and best is not None and near[best] >= 0.5:
            at = best + 1
    return out


class Runner:
    def __init__(self, command, folder):
        self.folder = folder
        self.changed = {}  # for --write: from a command to its lines in the page, anew
        self.environment = {**os.environ, "PATH": f"{command.parent}:{os.environ['PATH']}", "COLUMNS": "200"}

    def run(self, script):
        """Exit status and lines of a script; errors and results in one stream, as on a terminal."""
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=self.folder, env=self.environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
        return done.returncode, done.stdout.splitlines()

    def check(self, script, status=0, shown=None):
        code, printed = self.run(script)
        if code != status:
            return f"exit status {code} instead of {status}: {script.strip()}\n" + "\n".join(printed[-20:])
        line = None if shown is None else missing_line(shown, printed)
        if line:
            self.changed[script] = shown, rewritten(shown, printed)
        return line and f"not printed by {script.strip()}:\n{line}\nprinted was:\n" + "\n".join(printed)

    def sh(self, block):
        return self.check(block.text)

    def console(self, block):
        status = int(block.option("exit") or 0)
        commands = []
        for line in block.lines:
            if line.startswith("$ "):
                commands.append((line[2:], []))
            elif commands:
                commands[-1][1].append(line)
            else:
                return "a console block begins with a command: $ ..."
        faults = []
        for script, shown in commands:
            while shown and not shown[-1].strip():
                shown.pop()
            faults.append(self.check(script, status, shown))
        return "\n\n".join(filter(None, faults))

    def toml(self, block):
        try:
            keys = tomllib.loads(block.text).keys()
        except tomllib.TOMLDecodeError as error:
            return f"not TOML: {error}"
        name = block.option("file") or block.option("append")
        if name:
            with open(self.folder / name, "a" if block.option("append") else "w", encoding="utf-8") as file:
                file.write(("\n" if block.option("append") else "") + block.text)
        whole = name or "block.toml"
        if "finger" in keys or {"sensor", "material"} <= keys or block.option("append"):
            if not name:
                (self.folder / whole).write_text(block.text, encoding="utf-8")
            return self.check(f"tactile-net grasp {whole}" if "finger" in keys else f"tactile-net run {whole} --explain")
        return None

    def json(self, block):
        try:
            json.loads(block.text)
        except json.JSONDecodeError as error:
            return f"not JSON: {error}"
        return None

    def python(self, block):
        try:
            ast.parse(block.text)
        except SyntaxError as error:
            return f"not Python: {error}"
        return None


def main():
    command, project, page = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    document = Document(page)
    lines = page.read_text(encoding="utf-8").splitlines()
    known = {"sh", "console", "toml", "json", "python", "cpp", "text"}
    ran = 0
    with tempfile.TemporaryDirectory() as scratch:
        copy = pathlib.Path(scratch) / "project"
        copy.mkdir()
        for folder in ("scenes", "circuits", "docs", "examples"):
            shutil.copytree(project / folder, copy / folder)
        runner = Runner(command, copy)
        faults = []
        for block in document.blocks:
            fault = None
            if block.language not in known:
                fault = f"its language should be one of {', '.join(sorted(known))}"
            elif "no-run" in block.words:
                if block.line < 2 or not lines[block.line - 2].startswith("<!-- not run: "):
                    fault = "no-run without a comment <!-- not run: why --> above it"
            elif block.language not in ("cpp", "text"):
                fault = getattr(runner, block.language)(block)
                ran += 1
            if fault:
                faults.append(f"{page.relative_to(project)}:{block.line}: {fault}")
    if "--write" in sys.argv:
        text = page.read_text(encoding="utf-8")
        for script, (old, new) in runner.changed.items():
            command_line = f"$ {script}\n"
            text = text.replace(command_line + "\n".join(old), command_line + "\n".join(new), 1)
        page.write_text(text, encoding="utf-8", newline="\n")
    print("\n\n".join(faults) or f"{page.relative_to(project)}: {ran} of {len(document.blocks)} blocks run")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

"""The examples run, are short, and are typed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from conftest import PROJECT

EXAMPLES = sorted((PROJECT / "python/examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(example: Path, tmp_path: Path) -> None:
    text = example.read_text()
    if "\nimport mujoco" in text:
        pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install tactile-net[mujoco]")
    lines = text.splitlines()
    assert len(lines) < 60 and lines[0] == "# %% [markdown]" and lines[1].startswith("# # ")
    (tmp_path / "scenes").symlink_to(PROJECT / "scenes")
    environment = os.environ | {"MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, "-B", "-W", "error", example],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    assert "nan" not in done.stdout and len(done.stdout.splitlines()) >= 3
    pictures = list(tmp_path.glob("*.png"))
    assert len(pictures) == text.count("savefig")
    assert all(picture.stat().st_size > 5000 for picture in pictures)


def test_examples_and_package_are_typed(tmp_path: Path) -> None:
    if shutil.which("mypy", path=str(Path(sys.executable).parent)) is None:
        pytest.skip("mypy is not installed")
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import tactile_net as tn\ntn.Scene.load(3)\ntn.Plan.lode('x')\n")
    check = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", f"--cache-dir={tmp_path}/cache"]
    there = [str(one) for one in EXAMPLES if find_spec("mujoco") or "\nimport mujoco" not in one.read_text()]
    assert len(there) >= 9
    for what in (there, ["--package", "tactile_net"]):
        done = subprocess.run([*check, *what], cwd=tmp_path, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout
    done = subprocess.run([*check, str(wrong)], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert "incompatible type" in done.stdout and 'no attribute "lode"' in done.stdout

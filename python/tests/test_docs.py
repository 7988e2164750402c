"""What the docs show in Python does what they say: their blocks run one after another, page by page."""

from __future__ import annotations

import contextlib
import io
import os
import shutil
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import PROJECT

sys.path.append(str(PROJECT / "tests/docs"))
from blocks_test import missing_line  # noqa: E402
from markdown_page import Document  # noqa: E402

PAGES = [
    page
    for page in [PROJECT / "README.md", *sorted((PROJECT / "docs").rglob("*.md"))]
    if "\n```python" in page.read_text(encoding="utf-8")
]


def test_there_are_pages() -> None:
    assert PROJECT / "README.md" in PAGES and PROJECT / "docs/python.md" in PAGES


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_blocks_of_a_page(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A block ```text below one in Python is what that prints."""
    if "\nimport mujoco" in page.read_text(encoding="utf-8"):
        pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install tactile-net[mujoco]")
    shutil.copytree(PROJECT / "scenes", tmp_path / "scenes")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(os.environ, "MPLBACKEND", "Agg")
    names: dict[str, Any] = {"__name__": "__main__"}
    before = None
    printed: list[str] = []
    for block in Document(page).blocks:
        if block.language == "toml" and block.option("file"):
            (tmp_path / str(block.option("file"))).write_text(block.text, encoding="utf-8")
        elif block.language == "python" and "no-run" not in block.words:
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile("\n" * block.line + block.text, str(page), "exec"), names)
            printed = out.getvalue().splitlines()
        elif block.language == "text" and before is not None and before.language == "python":
            line = missing_line(block.lines, printed)
            assert line is None, f"{page.name}:{block.line}: not printed: {line}\nprinted was:\n" + "\n".join(printed)
        before = block

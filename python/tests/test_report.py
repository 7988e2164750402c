"""Many recordings side by side: the rows that the command writes."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import tactile_net as tn

OWN = {"page", "seconds"}


def own(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [{key: value for key, value in row.items() if key not in OWN} for row in rows]


@pytest.mark.parametrize("kind", ["scene", "skin"])
def test_the_rows_are_the_commands(
    kind: str, tmp_path: Path, command: Callable[..., str], request: pytest.FixtureRequest
) -> None:
    pad: tn.Scene = request.getfixturevalue(kind)
    folder = tmp_path / "a 'few' of them"
    folder.mkdir()
    for name, force in (("soft", 0.2), ("hard", 0.6)):
        timed = pad.replace({"contact.0.force": force, "time": {"rate": 100.0, "frames": 4}})
        timed.simulate().save(folder / f"{name}.csv")
    (tmp_path / "pad.toml").write_text(pad.replace({"contact": None}).text)
    scene = tn.Scene.load(tmp_path / "pad.toml")

    found = tn.report(folder, scene)
    command("report", folder, "--scene", tmp_path / "pad.toml", "--out", tmp_path / "out")
    assert own(found.rows) == own(json.loads((tmp_path / "out/result.json").read_text())["recordings"])
    assert len(found) == 2
    head, *rows = csv.reader(io.StringIO(found.csv))
    assert head == list(found.rows[0])
    assert [row[0] for row in rows] == [row["recording"] for row in found.rows]

    (folder / "broken.csv").write_text("stress_x_0\nno number\n")
    with_broken = tn.report([folder / "broken.csv", folder], scene)
    assert with_broken.rows[0]["standing"] == "no_answer"
    assert with_broken.rows[0]["problem"]
    assert own(with_broken.rows[1:]) == own(found.rows)


def test_a_report_is_a_table(tmp_path: Path, two: tn.Scene) -> None:
    pandas = pytest.importorskip("pandas")
    two.simulate().save(tmp_path / "one.csv")
    found = tn.report([tmp_path / "one.csv"], two)
    table = found.to_dataframe()
    assert isinstance(table, pandas.DataFrame)
    assert list(table["recording"]) == [str(tmp_path / "one.csv")]
    assert table["frames"][0] == 5


def test_what_is_not_there_is_refused(tmp_path: Path, two: tn.Scene) -> None:
    two.simulate().save(tmp_path / "one.csv")
    (tmp_path / ".hidden.csv").write_text("stress_x_0\n1\n")
    assert len(tn.report(tmp_path, two)) == 1
    with pytest.raises(tn.InputError, match="gone.csv: error: is not there"):
        tn.report([tmp_path / "one.csv", tmp_path / "gone.csv"], two)
    (tmp_path / "empty").mkdir()
    with pytest.raises(tn.InputError, match="holds no file"):
        tn.report(tmp_path / "empty", two)

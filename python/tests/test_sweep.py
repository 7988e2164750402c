"""Sweeps: what the command makes of a study, and what becomes of one that is stopped."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT

import tactile_net as tn

COMMAND = os.environ.get("TACTILE_NET_COMMAND", "tactile-net")
AXES: dict[str, Any] = {
    "sensor.depth": [0.5, 1.0, np.float64(2.0)],
    "noise.rms": {"from": 1e-4, "to": 1e-2, "count": 2, "scale": "log"},
}


@pytest.fixture
def study() -> tn.Study:
    scene = tn.Scene.load(PROJECT / "scenes/sweeps/pad.toml").replace({"reconstruct.alpha": 1e-3})
    return tn.Study(scene, AXES, repeats=2, title="Depths")


def table_of(answer: tn.SweepTable | None) -> tn.SweepTable:
    assert answer is not None
    return answer


def test_the_command_finds_the_same(study: tn.Study, tmp_path: Path) -> None:
    table = table_of(tn.sweep(study, tmp_path / "rows.csv", jobs=2))
    path = study.save(tmp_path)
    subprocess.run([COMMAND, "sweep", path, "-o", str(tmp_path / "command.csv")], check=True, capture_output=True)
    own, command = ((tmp_path / name).read_text(encoding="utf-8").splitlines() for name in ("rows.csv", "command.csv"))
    assert own == command
    assert table.csv.splitlines() == [line.partition(",")[2] for line in command[1:]]
    assert table.title == "Depths" and table.points == len(table) == 12
    assert table.axes == ("sensor.depth", "noise.rms", "repeat")
    assert set(table["sensor.depth"]) == {0.5, 1.0, 2.0}
    assert table["index"].tolist() == list(range(12))
    assert len(set(table["seed"])) == 12
    assert np.isfinite(table["error"]).all() and (table["verdict"] == "ok").all()
    assert np.isnan(table["error_tangential"]).all()


def test_a_point_is_the_scene_with_its_values(study: tn.Study, tmp_path: Path) -> None:
    table = table_of(tn.sweep(study, tmp_path / "rows.csv"))
    for i in (0, 7):
        changes = {key: table[key][i] for key in AXES} | {"noise.seed": int(table["seed"][i])}
        answer = tn.run(study.scene.replace(changes)).methods["tikhonov"]
        assert answer.relative_error == table["error"][i]
        assert answer.force == table["force"][i]


def test_parts(study: tn.Study, tmp_path: Path) -> None:
    whole = table_of(tn.sweep(study, tmp_path / "whole.csv"))
    assert tn.sweep(study, tmp_path / "part.csv", points=(0, 5)) is None
    assert tn.sweep(study, tmp_path / "part.csv", points=(8, 99)) is None
    with pytest.raises(RuntimeError, match="3 of 12 points are missing, 5:8"):
        tn.merge(tmp_path / "part.csv")
    assert tn.sweep(study, tmp_path / "other.csv", points=(5, 8)) is None
    assert tn.merge(tmp_path / "part.csv", tmp_path / "other.csv").sha256 == whole.sha256


def test_ctrl_c_keeps_what_is_done(study: tn.Study, tmp_path: Path) -> None:
    path = tn.Study(study.scene.replace({"reconstruct.alpha": "rgcv"}), AXES, repeats=40).save(tmp_path)
    # A shell's job in the background ignores the signal, and so would its children.
    heard = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    script = f"{heard}import tactile_net as tn\ntry:\n    tn.sweep({path!r}, {str(tmp_path / 'rows.csv')!r}, jobs=2)\nexcept KeyboardInterrupt:\n    print('stopped')"
    with subprocess.Popen([sys.executable, "-B", "-c", script], stdout=subprocess.PIPE, text=True) as process:
        end = time.monotonic() + 60
        while not ((tmp_path / "rows.csv").exists() and (tmp_path / "rows.csv").stat().st_size > 3000) and time.monotonic() < end:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=60)[0] == "stopped\n"
    steps: list[str] = []
    table = table_of(tn.sweep(path, tmp_path / "rows.csv", progress=steps.append))
    assert table.points == 240
    assert steps[-1] == "240 of 240 points, 100 %"


def test_what_is_wrong(study: tn.Study, tmp_path: Path) -> None:
    with pytest.raises(tn.InputError, match="did you mean depth"):
        tn.sweep(tn.Study(study.scene, {"sensor.deth": [1.0]}), tmp_path / "a")
    with pytest.raises(tn.InputError, match="at least one value"):
        tn.sweep(tn.Study(study.scene, {"sensor.depth": []}), tmp_path / "b")
    with pytest.raises(TypeError, match="no scene holds"):
        tn.sweep(tn.Study(study.scene, {"sensor.depth": [{1.0}]}), tmp_path / "c")
    for points in ((5, 4), (4, 4), (-1, 4)):
        with pytest.raises(ValueError, match="points"):
            tn.sweep(study, tmp_path / "d", points=points)
    with pytest.raises(tn.InputError, match="none from 12 on"):
        tn.sweep(study, tmp_path / "d", points=(12, 20))
    with pytest.raises(ValueError, match="jobs"):
        tn.sweep(study, tmp_path / "e", jobs=0)
    with pytest.raises(ValueError, match="jobs"):
        tn.sweep(study, tmp_path / "e", jobs=1, client=object())
    with pytest.raises(tn.InputError, match="is a folder"):
        tn.merge(tmp_path)
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    with pytest.raises(tn.InputError, match="is not a file of rows"):
        tn.sweep(study, tmp_path / "file")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "mine"
    with pytest.raises(OSError, match="cannot be written to"):
        tn.sweep(study, tmp_path / "none/rows.csv")
    tn.sweep(study, tmp_path / "rows.csv")
    with pytest.raises(tn.InputError, match="another study"):
        tn.sweep(tn.Study(study.scene, AXES, repeats=3), tmp_path / "rows.csv")


def test_failures_are_rows(study: tn.Study, tmp_path: Path) -> None:
    table = table_of(tn.sweep(tn.Study(study.scene, {"sensor.depth": [-1.0, 1.0]}), tmp_path / "rows.csv"))
    assert table["failure"].tolist() == ["sensor.depth must be > 0", ""]
    assert np.isnan(table["error"][0])


def test_tables(study: tn.Study, tmp_path: Path) -> None:
    table = table_of(tn.sweep(tn.Study(study.scene, {"reconstruct.alpha": ["rgcv", 1e-3]}), tmp_path / "rows.csv"))
    assert table["reconstruct.alpha"].tolist() == ["rgcv", "0.001"]
    frame = table.to_dataframe()
    assert list(frame.columns) == list(table.columns) and len(frame) == 2
    assert "SweepTable" in repr(table) and "<table" in table._repr_html_()
    assert Path(table.report(tmp_path / "page")).exists()
    assert (tmp_path / "page/results.csv").read_text(encoding="utf-8") == table.csv


def test_parquet(study: tn.Study, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    table = table_of(tn.sweep(study, tmp_path / "rows.csv"))
    table.to_parquet(tmp_path / "rows.parquet")
    again = parquet.read_table(tmp_path / "rows.parquet")
    assert again.schema.metadata[b"tactile_net.sha256"].decode() == table.sha256
    for name, values in table.columns.items():
        np.testing.assert_array_equal(again[name].to_numpy(zero_copy_only=False), values)


def test_the_json_is_the_commands(study: tn.Study, tmp_path: Path) -> None:
    table = table_of(tn.sweep(study, tmp_path / "rows.csv", jobs=2))
    document = table.to_dict()
    assert document["kind"] == "sweep" and document["points_resumed"] == 0
    assert document["results"]["sha256"] == table.sha256
    path = study.save(tmp_path)
    run = subprocess.run([COMMAND, "sweep", path, "-o", str(tmp_path / "rows.csv"), "--json", "-"], check=True, capture_output=True)
    again = table_of(tn.sweep(study, tmp_path / "rows.csv"))
    assert again.to_json() == run.stdout.decode()
    assert again.to_dict()["points_resumed"] == 12
    assert tn.merge(tmp_path / "rows.csv").to_dict()["points_resumed"] is None
    table.report(tmp_path / "page")
    assert (tmp_path / "page/result.json").read_text(encoding="utf-8") == table.to_json()


def test_units_of_the_axes(study: tn.Study, tmp_path: Path) -> None:
    scene = study.scene.replace({"units.length": "mm", "units.stress": "kPa"})
    table = table_of(tn.sweep(tn.Study(scene, AXES, repeats=2), tmp_path / "rows.csv"))
    assert table.units == {"sensor.depth": "mm", "noise.rms": "kPa", "repeat": None}


def test_what_is_kept(study: tn.Study, tmp_path: Path) -> None:
    axes = {"sensor.depth": [-1.0, 0.5, 1.0]}
    keep = ["tractions", "force", "readings"]
    table = table_of(tn.sweep(tn.Study(study.scene, axes, keep=keep), tmp_path / "rows.csv"))
    assert "error" not in table.columns
    assert table["readings"].shape == (3, 41)
    assert table["tractions"].ndim == 1 or table["tractions"].shape[0] == 3  # the grid's margin follows the depth
    assert np.isnan(table["readings"][0]).all()
    answer = tn.run(study.scene.replace({"sensor.depth": 1.0, "noise.seed": int(table["seed"][2])})).methods["tikhonov"]
    np.testing.assert_array_equal(table["tractions"][2], answer.normal)
    uneven = tn.Study(study.scene, {"sensor.count": [9, 11]}, keep=["readings"])
    assert [len(row) for row in table_of(tn.sweep(uneven, tmp_path / "uneven"))["readings"]] == [9, 11]
    with pytest.raises(tn.InputError, match="did you mean"):
        tn.sweep(tn.Study(study.scene, axes, keep=["traction"]), tmp_path / "wrong")


def test_kept_lists_in_tables(study: tn.Study, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    table = table_of(tn.sweep(tn.Study(study.scene, {"noise.seed": [1, 2]}, keep=["readings"]), tmp_path / "rows.csv"))
    table.to_parquet(tmp_path / "rows.parquet")
    again = parquet.read_table(tmp_path / "rows.parquet")
    np.testing.assert_array_equal(np.array(again["readings"].to_pylist()), table["readings"])
    assert again.schema.metadata[b"tactile_net.json"].decode() == table.to_json()
    assert len(table.to_dataframe()["readings"][0]) == 41

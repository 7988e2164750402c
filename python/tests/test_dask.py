"""Sweeps and data sets on Dask: the rows of one machine, whoever is killed meanwhile."""

from __future__ import annotations

import os
import shutil
import signal
from collections import deque
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from conftest import PROJECT

import tactile_net as tn
from tactile_net import _core, _points, _sweep

distributed: Any = pytest.importorskip("distributed")
dask: Any = pytest.importorskip("dask")

pytestmark = pytest.mark.filterwarnings("default")  # what they and their workers say is theirs


@pytest.fixture
def client() -> Iterator[Any]:
    settings = {"distributed.scheduler.allowed-failures": 1, "distributed.comm.retry.count": 0}
    with (
        dask.config.set(settings),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster,
        distributed.Client(cluster) as one,
    ):
        yield one


@pytest.fixture
def study(scene: tn.Scene) -> tn.Study:
    return tn.Study(scene, {"sensor.depth": {"from": 1e-3, "to": 2e-3, "count": 30}}, repeats=4)


def hash_here(study: tn.Study, folder: Path) -> str:
    table = tn.sweep(study, folder / "here.csv")
    assert table is not None
    return table.sha256


def test_the_rows_are_those_of_this_machine(client: Any, study: tn.Study, tmp_path: Path) -> None:
    told: list[str] = []
    assert tn.sweep(study, tmp_path / "rows.csv", client=client, points=(3, 50)) is None
    table = tn.sweep(study, tmp_path / "rows.csv", client=client, progress=told.append)
    assert table is not None and table.sha256 == hash_here(study, tmp_path)
    assert table.to_dict()["points_resumed"] == 47 and told[-1] == "73 of 73 points"
    with pytest.raises(tn.InputError, match="another study"):
        tn.sweep(tn.Study(study.scene, study.axes), tmp_path / "rows.csv", client=client)


def test_quick_points_travel_together(
    client: Any, scene: tn.Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = tn.Study(scene, {"sensor.depth": {"from": 1e-3, "to": 2e-3, "count": 30}}, repeats=40)
    tasks: list[int] = []
    submit = client.submit

    def counted(*given: Any, **how: Any) -> Any:
        tasks.append(len(given[-1]))
        return submit(*given, **how)

    monkeypatch.setattr(client, "submit", counted)
    table = tn.sweep(study, tmp_path / "rows.csv", client=client)
    assert table is not None and table.sha256 == hash_here(study, tmp_path)
    assert sum(tasks) == 1200 and len(tasks) < 150
    assert max(tasks) <= 1200 // 8


def test_slow_points_and_those_that_are_tried_alone_do_not() -> None:
    def joined(parts: list[list[int]], seconds: float) -> list[int]:
        return _points._joined(deque(parts), 2, seconds)

    pairs = [[8, 9], [0, 1], [2, 3], [4, 5], [6, 7]]
    assert joined(pairs, 1e-6) == [0, 1, 8, 9]
    assert joined(pairs, _points.long_enough) == [8, 9]
    assert joined([[i] for i in range(10)], 1e-6) == [0]


def test_workers_that_are_killed_cost_nothing_but_time(client: Any, study: tn.Study, tmp_path: Path) -> None:
    killed: list[int] = []

    def kill(_: str) -> None:
        if len(killed) < 2:
            pids = sorted(set(client.run(os.getpid, on_error="ignore").values()) - set(killed))
            if pids:
                killed.append(pids[0])
                os.kill(pids[0], signal.SIGKILL)

    table = tn.sweep(study, tmp_path / "rows.csv", client=client, progress=kill)
    assert len(killed) == 2
    assert table is not None and table.sha256 == hash_here(study, tmp_path)


@pytest.mark.parametrize("deadly", [{7}, set(range(120))], ids=["one point", "every point"])
def test_points_that_kill_are_named(
    client: Any, study: tn.Study, deadly: set[int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    honest = _sweep._rows

    def rows(study: _points.StudyCopy, indices: list[int]) -> str:  # of this test alone: travels by value
        import os

        if deadly.intersection(indices):
            os.kill(os.getpid(), 9)
        return honest(study, indices)

    monkeypatch.setattr(_sweep, "_rows", rows)
    monkeypatch.setattr(_points, "patience", 5.0)  # Dask gives up restarting workers that die at once
    which = "point 7 of 120 is missing" if len(deadly) == 1 else "120 of 120 points are missing, 0:120"
    with pytest.raises(RuntimeError, match=f"workers died.*{which}"):
        tn.sweep(study, tmp_path / "rows.csv", client=client)
    lines = (tmp_path / "rows.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 2 + 120 - len(deadly)
    table = tn.sweep(study, tmp_path / "rows.csv")
    assert table is not None and table.sha256 == hash_here(study, tmp_path)


def test_data_sets(client: Any, study: tn.Study, tmp_path: Path) -> None:
    pytest.importorskip("zarr")
    there = tn.datasets.generate(study, tmp_path / "there.zarr", client=client, chunk=50)
    assert there.sha256 == tn.datasets.generate(study, tmp_path / "here.zarr").sha256


def test_a_study_travels_with_its_files(tmp_path: Path) -> None:
    base = tn.Scene.load(PROJECT / "scenes/coarse/strip.toml")
    name = base.to_dict()["sensor"]["taxels"]
    home = tmp_path / "home"
    (home / name).parent.mkdir(parents=True)
    shutil.copy(PROJECT / "scenes/coarse" / name, home / name)
    path = tn.Study(base, {"noise.seed": [1, 2]}).save(home)
    points = _core.StudyPoints(path, False)
    copy = _points.StudyCopy.of(path, points, False)
    rows = points.rows([0, 1])
    shutil.rmtree(home)
    assert copy.points().rows([0, 1]) == rows
    with pytest.raises(RuntimeError, match="another study on a worker"):
        _points.StudyCopy(copy.path, copy.files, False, copy.version, "0" * 64).points()
    with pytest.raises(RuntimeError, match="install one version"):
        _points.StudyCopy(copy.path, copy.files, False, "0.0.1", "1" * 64).points()

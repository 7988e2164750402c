"""Data sets of studies: the points of a sweep with their seeds, in chunks that may be stopped, as Parquet and as Zarr."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT

import tactile_net as tn
from tactile_net import _core


@pytest.fixture
def study(scene: tn.Scene) -> tn.Study:
    timed = scene.replace(
        {
            "time": {"rate": 100.0, "frames": 3},
            "sensor.reads": ["stress_x", "shear_xy"],
            "contact.0.force": None,
            "contact.0.trajectory": [{"t": 0.0, "force": 1.0}, {"t": 0.02, "force": 2.0}],
        }
    )
    return tn.Study(timed, {"contact.0.friction": [0.0, 0.3], "noise.rms": [1.0, 5.0]}, repeats=2)


@pytest.fixture
def skin() -> tn.Study:
    base = tn.Skin(
        sensor=tn.Sensor(rows=4, columns=3, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=2.5e-3, friction=0.4)],
        noise=tn.Noise(rms=10.0),
        units={},
    )
    return tn.Study(base, {"contact.0.force": {"from": 0.1, "to": 1.0}}, draw={"kind": "sobol", "count": 6})


@pytest.fixture(params=["parquet", "zarr"])
def store(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    pytest.importorskip("pyarrow" if request.param == "parquet" else "zarr")
    return tmp_path / f"frames.{request.param}"


def test_a_data_set_is_its_points_scenes(study: tn.Study, store: Path, tmp_path: Path) -> None:
    data = tn.datasets.generate(study, store)
    assert data.readings.shape == (24, 2, 21) and data.readings.dtype == np.float32
    assert data.tractions is not None and data.tractions.shape == (24, 2, 21)
    assert data.axes == ("contact.0.friction", "noise.rms", "repeat")
    assert np.array_equal(data.point, np.repeat(np.arange(8), 3))
    table = tn.sweep(study, tmp_path / "rows.csv", jobs=1)
    assert table is not None
    assert np.array_equal(data.parameters["seed"], table["seed"])  # those of the sweep
    for point in (0, 5):
        values = {key: float(data.parameters[key][point]) for key in ("contact.0.friction", "noise.rms")}
        scene = study.scene.replace(values | {"noise.seed": int(data.parameters["seed"][point])})
        recording = scene.simulate()
        assert np.array_equal(data.readings[data.point == point], recording.readings.astype(np.float32))
        assert recording.truth is not None
        truth = data.tractions[data.point == point][:, : recording.truth.shape[1]]
        assert np.array_equal(truth, recording.truth.astype(np.float32))
    assert (data["noise.rms"] == np.repeat([1, 1, 5, 5, 1, 1, 5, 5], 3)).all()


def test_formats_and_chunks_make_the_same_data_set(study: tn.Study, skin: tn.Study, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    pytest.importorskip("zarr")
    once = tn.datasets.generate(study, tmp_path / "one.parquet", jobs=3)
    for name, chunk in (("a.parquet", 1), ("b.parquet", 3), ("c.zarr", 3), ("d.zarr", 100)):
        many = tn.datasets.generate(study, tmp_path / name, chunk=chunk, jobs=2)
        assert many.sha256 == once.sha256 and np.array_equal(many.readings, once.readings)
        assert many.tractions is not None and once.tractions is not None
        assert np.array_equal(many.tractions, once.tractions)
        assert np.array_equal(many.point, once.point)
        for key, values in once.parameters.items():
            assert np.array_equal(many.parameters[key], values) and many.parameters[key].dtype == values.dtype
    other = tn.datasets.generate(tn.Study(study.scene, study.axes, repeats=2, seed=2), tmp_path / "other.zarr")
    assert other.sha256 != once.sha256
    of_skin = [tn.datasets.generate(skin, tmp_path / name, chunk=4) for name in ("skin.parquet", "skin.zarr")]
    assert of_skin[0].sha256 == of_skin[1].sha256 and np.array_equal(of_skin[0].readings, of_skin[1].readings)


class _Stops(Exception):
    pass


def test_what_was_stopped_goes_on(study: tn.Study, store: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    once = tn.datasets.generate(study, tmp_path / f"once{store.suffix}")

    def stop(words: str) -> None:
        if words.startswith("5 "):
            raise _Stops

    with pytest.raises(_Stops):
        tn.datasets.generate(study, store, jobs=1, chunk=2, progress=stop)
    with pytest.raises(tn.InputError, match="lacks 4 of 8 points"):
        tn.datasets.load(store)
    (store / "chunk-000003.parquet.1.part").write_text("of a call that was killed")
    asked = []
    honest = _core.StudyPoints.simulate

    def simulate(self: Any, index: int) -> Any:
        asked.append(index)
        return honest(self, index)

    monkeypatch.setattr(_core.StudyPoints, "simulate", simulate)
    again = tn.datasets.generate(study, store, jobs=1, chunk=2)
    assert asked == [4, 5, 6, 7]
    assert again.sha256 == once.sha256 and np.array_equal(again.readings, once.readings)
    asked.clear()
    assert tn.datasets.generate(study, store, chunk=2).sha256 == once.sha256 and asked == []


def test_others_read_it(study: tn.Study, skin: tn.Study, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("zarr")
    data = tn.datasets.generate(study, tmp_path / "line.parquet", chunk=3)
    frame = pandas.read_parquet(tmp_path / "line.parquet")
    assert np.array_equal(np.stack(frame["readings"].to_numpy()), data.readings.reshape(len(data), -1))
    assert np.array_equal(frame["noise.rms"], data["noise.rms"])
    of_skin = tn.datasets.generate(skin, tmp_path / "skin.zarr", chunk=4)
    opened = xarray.open_zarr(tmp_path / "skin.zarr", consolidated=False)
    assert np.array_equal(opened["readings"].values[:, 0], of_skin.readings)
    assert opened["readings"].dims[:2] == ("point", "frame")


def test_skins(skin: tn.Study, store: Path, tmp_path: Path) -> None:
    data = tn.datasets.generate(skin, store)
    assert isinstance(data.scene, tn.Skin)
    assert data.readings.shape == (6, 4, 3, 3) and data.tractions is not None
    assert data.tractions.shape == (6, 3, *data.scene.traction_shape)
    recording = skin.scene.replace(
        {"contact.0.force": float(data["contact.0.force"][4]), "noise.seed": int(data["seed"][4])}
    ).simulate()
    assert np.array_equal(data.readings[4], recording.readings[0].astype(np.float32))
    assert recording.truth is not None and np.array_equal(data.tractions[4], recording.truth[0].astype(np.float32))
    pressed = data.scene.cell_area * data.tractions[:, 0].sum(axis=(1, 2))
    assert np.allclose(pressed, data["contact.0.force"], rtol=1e-5)
    table = tn.sweep(skin, tmp_path / "rows.csv", jobs=1)
    assert table is not None and len(table) == 6
    assert np.array_equal(table["seed"], data.parameters["seed"]) and (table["verdict"] == "ok").all()
    result = tn.run(skin.scene.replace({"contact.0.force": table["contact.0.force"][2], "noise.seed": int(table["seed"][2])}))
    assert isinstance(result, tn.SkinResult)
    assert table["force"][2] == result.skin.force and table["error"][2] == result.skin.relative_errors[0]
    alone = tn.datasets.generate(skin, tmp_path / f"alone{store.suffix}", keep=["readings"])
    assert alone.tractions is None and np.array_equal(alone.readings, data.readings)


def test_failures_are_points_without_frames(study: tn.Study, store: Path) -> None:
    data = tn.datasets.generate(tn.Study(study.scene, {"contact.0.half_width": [-1.0, 2e-3]}), store, chunk=1)
    assert data.parameters["failure"][1] == "" and "half_width" in data.parameters["failure"][0]
    assert data.point.tolist() == [1, 1, 1]
    with pytest.raises(tn.InputError, match="has no frame.*half_width"):
        tn.datasets.generate(
            tn.Study(study.scene, {"contact.0.half_width": [-1.0]}), store.with_name(f"none{store.suffix}")
        )


def test_frames_may_differ_in_number_in_parquet_alone(study: tn.Study, tmp_path: Path) -> None:
    uneven = tn.Study(study.scene, {"time.frames": [2, 3]})
    data = tn.datasets.generate(uneven, tmp_path / "a.parquet")
    assert data.point.tolist() == [0, 0, 1, 1, 1]
    with pytest.raises(tn.InputError, match="different numbers of frames"):
        tn.datasets.generate(uneven, tmp_path / "a.zarr")


def test_what_is_no_data_set(study: tn.Study, skin: tn.Study, store: Path, tmp_path: Path) -> None:
    def place(name: str) -> Path:
        return tmp_path / f"{name}{store.suffix}"

    with pytest.raises(tn.InputError, match="one shape"):
        tn.datasets.generate(tn.Study(study.scene, {"sensor.count": [21, 31]}), place("shapes"))
    with pytest.raises(tn.InputError, match="one shape.*reconstruct.spacing"):
        tn.datasets.generate(tn.Study(skin.scene, {"sensor.depth": [2e-3, 5e-4]}), place("depths"))
    fixed = skin.scene.replace({"reconstruct": {"spacing": 1e-3, "margin": 2e-3}})
    tn.datasets.generate(tn.Study(fixed, {"sensor.depth": [2e-3, 1.5e-3]}), place("fixed"))
    store.mkdir()
    with pytest.raises(tn.InputError, match="holds no data set"):
        tn.datasets.load(store)
    tn.datasets.generate(study, store)
    for repeats, seed in ((3, 1), (2, 7)):
        with pytest.raises(tn.InputError, match="another study"):
            tn.datasets.generate(tn.Study(study.scene, study.axes, repeats=repeats, seed=seed), store)
    with pytest.raises(tn.InputError, match="other chunks"):
        tn.datasets.generate(study, store, chunk=3)
    wrong: list[dict[str, Any]] = [{"chunk": 0}, {"keep": ["tractions"]}, {"keep": ["x"]}, {"jobs": 0}]
    for options in wrong:
        with pytest.raises(ValueError, match=next(iter(options))):
            tn.datasets.generate(study, place("options"), **options)
    with pytest.raises(ValueError, match="NAME.parquet or NAME.zarr"):
        tn.datasets.generate(study, tmp_path / "frames")
    import fcntl

    held = os.open(store, os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)
    with pytest.raises(OSError, match="writes into this store"):
        tn.datasets.generate(study, store)
    os.close(held)


def test_the_hash_of_a_study_covers_the_files_that_it_names(tmp_path: Path) -> None:
    base = tn.Scene.load(PROJECT / "scenes/coarse/strip.toml")
    name = base.to_dict()["sensor"]["taxels"]
    (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
    text = (PROJECT / "scenes/coarse" / name).read_text()
    (tmp_path / name).write_text(text)
    path = tn.Study(base, {"noise.seed": [1]}).save(tmp_path)
    before = _core.StudyPoints(path, False).hash
    assert _core.StudyPoints(path, False).hash == before
    (tmp_path / name).write_text(text.rstrip("\n") + "\n\n")
    assert _core.StudyPoints(path, False).hash != before

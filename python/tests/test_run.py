"""Results of a scene, and of whoever does not wait for them."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import PROJECT

import tactile_net as tn


def test_a_result_has_every_method_beside_the_truth(two: tn.Scene) -> None:
    scene = two.replace({"reconstruct.methods": ["tikhonov", "closed_form"]})
    result = scene.run()
    assert list(result.methods) == ["tikhonov", "closed_form"] == list(scene.methods)
    answer = result["tikhonov"]
    assert answer.verdict == "ok" and answer.alpha == 1e-3 and answer.alpha_source == "given"
    assert answer.tractions is not None and answer.tractions.shape == result.truth.shape == (2, len(result.y))
    assert np.array_equal(answer.normal, answer.tractions[0]) and answer.tangential is not None
    assert result.readings.shape == scene.reading_shape
    error = np.linalg.norm(answer.normal - result.truth[0]) / np.linalg.norm(result.truth[0])
    assert answer.relative_error == pytest.approx(error, rel=1e-12)
    assert answer.normal_force is not None and answer.force == pytest.approx(answer.normal_force[0], rel=1e-12)
    assert "tikhonov" in str(result) and "tikhonov ok" in repr(result)
    assert "<svg" in result._repr_html_() and "<table>" in result._repr_html_()


def test_a_frame_of_a_scene_with_time(two: tn.Scene) -> None:
    growing = [{"t": 0.0, "force": 0.0}, {"t": 0.04, "force": 1.0}]
    scene = two.replace({"contact.0.force": None, "contact.0.trajectory": growing})
    recording = scene.simulate()
    for frame in (1, 4):
        assert np.array_equal(tn.run(scene, frame=frame).readings, recording.readings[frame])
    with pytest.raises(ValueError, match="frame"):
        tn.run(scene, frame=5)


def test_a_method_that_cannot_take_the_scene_is_a_result(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    failed = tn.run(tn.Scene.load(PROJECT / "scenes/nic.toml"))
    assert not failed.succeeded and "failed" in repr(failed)
    assert "ngspice" in failed["network"].failure
    with pytest.raises(ValueError, match="ngspice"):
        _ = failed["network"].normal


def test_a_simulator_that_fails_says_what_it_was_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = tn.Scene.load(PROJECT / "scenes/nic.toml")
    broken = tmp_path / "ngspice"
    broken.write_text("#!/bin/sh\necho singular matrix\nexit 1\n")
    broken.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setenv("TMPDIR", str(tmp_path))  # where deck and log are kept
    with pytest.raises(tn.SimulatorError) as caught:
        scene.relax()
    assert isinstance(caught.value, RuntimeError)
    assert ".op" in caught.value.deck and "singular matrix" in caught.value.log
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(tn.SimulatorError, match="ngspice"):
        scene.relax()


def test_a_result_is_pickled_as_arrays(two: tn.Scene, tmp_path: Path) -> None:
    result = two.run()
    again = pickle.loads(pickle.dumps(result))
    assert again.to_json() == result.to_json() and str(again) == str(result)
    assert np.array_equal(again["tikhonov"].normal, result["tikhonov"].normal)
    again.report(tmp_path / "again")
    result.report(tmp_path / "first")
    assert (tmp_path / "again/report.html").read_text() == (tmp_path / "first/report.html").read_text()


def test_tables_of_a_result(two: tn.Scene) -> None:
    pytest.importorskip("xarray")
    result = two.replace({"reconstruct.methods": ["tikhonov", "closed_form"]}).run()
    dataset = result.to_xarray()
    assert np.array_equal(dataset["tractions"].sel(by="closed_form"), result["closed_form"].tractions)
    table = result.to_dataframe()
    assert table.loc["tikhonov", "verdict"] == "ok"


def test_whoever_listens_hears_the_steps(scene: tn.Scene) -> None:
    heard: list[str] = []
    tn.run(scene, progress=heard.append)
    assert any("tikhonov" in sentence for sentence in heard)

    def stop(sentence: str) -> None:
        raise InterruptedError(sentence)

    with pytest.raises(InterruptedError):
        tn.run(scene, progress=stop)
    assert tn.run(scene, progress=True).succeeded


@pytest.mark.parametrize("what", ["tn.run(scene)", "scene.simulate()", "recording.solve().deviation"])
def test_ctrl_c_ends_it(what: str) -> None:
    script = f"""
import os, signal, threading
import tactile_net as tn
scene = tn.Scene.load({str(PROJECT / "scenes/effects/everything.toml")!r})
scene = scene.replace({{"time": {{"rate": 200.0, "frames": 20000}}, "reconstruct.alpha": None}})
recording = scene.replace({{"time": {{"rate": 200.0, "frames": 400}}}}).simulate() if "recording" in {what!r} else None
signal.signal(signal.SIGINT, signal.default_int_handler)  # whoever started the tests may ignore it
threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    while True:
        {what}
except KeyboardInterrupt:
    print("ended")
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.stdout == "ended\n", done.stderr

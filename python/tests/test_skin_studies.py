"""Skins before there is a reading, and recordings before they are trusted: surveys, circuits, checks, gaps."""

from __future__ import annotations

import json
import pickle
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import PROJECT

import tactile_net as tn

CIRCUIT = PROJECT / "scenes/skins/circuit.toml"
RECORDED = PROJECT / "scenes/recorded"


@pytest.mark.parametrize("name", ["sphere", "pressure-alone", "palm"])
def test_surveys_of_skins(command: Callable[..., str], name: str, tmp_path: Path) -> None:
    path = PROJECT / f"scenes/skins/{name}.toml"
    survey = tn.Skin.load(path).identify()
    command("identify", path, "--json", tmp_path / "survey.json", "--out", tmp_path / "theirs")
    assert survey.to_json() == (tmp_path / "survey.json").read_text()
    survey.report(tmp_path / "ours")
    assert {p.name for p in (tmp_path / "ours").iterdir()} == {p.name for p in (tmp_path / "theirs").iterdir()}
    text = command("identify", path)
    assert all(sentence in text for sentence in survey.words) and len(survey.table) > 5
    assert survey.normal == survey.wavelengths["normal"]
    drags = [survey.wavelengths[f"drag_{which}"] for which in ("along", "across")]
    assert survey.tangential == (None if None in drags else max(drag for drag in drags if drag is not None))
    assert survey.shares and survey.hides == any(entry["count"] > 0 for entry in hidden(survey.to_dict()))
    again = pickle.loads(pickle.dumps(survey))
    assert again.words == survey.words and again.wavelengths == survey.wavelengths
    again.report(tmp_path / "again")


def hidden(document: dict[str, object]) -> list[dict[str, int]]:
    """What no wave shows, and what no reading of the array does."""
    waves = document["hidden"]
    assert isinstance(waves, list)
    kinds = ("pressure", "drag_along", "drag_across", "mixed")
    found = [{"count": sum(int(wave[kind]) for kind in kinds)} for wave in waves]
    deficiency = document["rank_deficiency"]
    return found + ([{"count": deficiency}] if isinstance(deficiency, int) else [])


def test_pressure_alone_hides_what_the_symbol_says() -> None:
    sphere = tn.Skin.load(PROJECT / "scenes/skins/sphere.toml")
    alone = sphere.replace({"sensor.reads": ["stress_x"], "sensor.depth": None, "sensor.depths": [2.0, 3.0]})
    survey = alone.identify()
    assert survey.hides and survey.tangential is None and survey.normal is not None
    assert any("The curl of q is seen by no depth of stress_x" in sentence for sentence in survey.words)


def test_circuits_of_skins(command: Callable[..., str], tmp_path: Path) -> None:
    skin = tn.Skin.load(CIRCUIT)
    command("certify", CIRCUIT, "--json", tmp_path / "certificate.json")
    certification = skin.certify()
    assert certification.to_json() == (tmp_path / "certificate.json").read_text()
    assert certification.stability == "stable" and certification.realization == "least_squares"
    assert skin.netlist() == command("gen", CIRCUIT)
    assert skin.netlist("crossbar") == command("gen", CIRCUIT, "--realization", "crossbar")
    small = skin.replace({"reconstruct.nonnegative": True})
    for call in (small.certify, small.netlist, small.relax):
        with pytest.raises(ValueError, match="holds no constraints"):
            call()
    with pytest.raises(ValueError, match="amplifiers, more than 1024|branches of P, more than 20000"):
        tn.Skin.load(PROJECT / "scenes/skins/pressure-pad.toml").netlist()


@pytest.mark.parametrize("name", ["circuit", "row", "palm"])
def test_plans_of_skins(command: Callable[..., str], name: str, tmp_path: Path) -> None:
    path = PROJECT / f"scenes/skins/{name}.toml"
    command("plan", path, "--accuracy", "1e-5", "-o", tmp_path / "skin.plan")
    plan = tn.Skin.load(path).plan(accuracy=1e-5)
    assert plan.to_bytes() == (tmp_path / "skin.plan").read_bytes()
    assert tn.Plan.load(tmp_path / "skin.plan", scene=tn.Skin.load(path)) == plan


needs_ngspice = pytest.mark.skipif(shutil.which("ngspice") is None, reason="ngspice is not installed")


@needs_ngspice
def test_relaxations_of_skins() -> None:
    skin = tn.Skin.load(CIRCUIT)
    relaxation = skin.relax()
    direct = skin.simulate().solve().tractions[0]
    assert relaxation.agrees and relaxation.tractions.shape == direct.shape == (3, *skin.traction_shape)
    assert np.abs(relaxation.tractions - direct).max() < 1e-3 * np.abs(direct).max()
    assert np.array_equal(relaxation.y, skin.y) and np.array_equal(relaxation.z, skin.z)
    fine = skin.replace({"reconstruct.spacing": 1.0, "network.spacing": 2.0})
    wide = fine.relax("ideal")
    assert wide.tractions.shape == (3, len(wide.y), len(wide.z)) and len(wide.y) < len(fine.y)
    line = tn.Scene.load(PROJECT / "scenes/nic.toml")
    assert np.array_equal(line.relax().y, line.y) and line.relax().z.size == 0


@needs_ngspice
def test_a_run_with_its_circuit(command: Callable[..., str], tmp_path: Path) -> None:
    skin = tn.Skin.load(CIRCUIT)
    result = tn.run(skin, realization="ideal")
    circuit, answer = result["network"], result.skin
    assert result.succeeded and list(result.methods) == ["tikhonov", "network"] and circuit.verdict == "ok"
    assert circuit.tractions is not None and answer.tractions is not None
    assert np.abs(circuit.tractions - answer.tractions).max() < 1e-6 * np.abs(answer.tractions).max()
    assert circuit.relative_error == pytest.approx(answer.relative_error, rel=1e-5) and circuit.alpha == answer.alpha
    command("run", CIRCUIT, "--realization", "ideal", "--json", tmp_path / "theirs.json")
    theirs = json.loads((tmp_path / "theirs.json").read_text())
    assert result.to_dict()["reconstructions"][1]["error"] == theirs["reconstructions"][1]["error"]
    refused = tn.run(skin.replace({"reconstruct.nonnegative": True}), realization="ideal")
    assert not refused.succeeded and refused["network"].verdict == "failed" and refused.skin.verdict == "ok"
    assert "holds no constraints" in refused["network"].failure and "network" not in tn.run(skin).methods
    line = tn.run(tn.Scene.load(PROJECT / "scenes/fingertip.toml").replace({"reconstruct.alpha": 1e-3}), realization="ideal")
    assert line["network"].verdict == "ok"


@pytest.mark.parametrize("name", ["skin-pad", "thin-pad"])
def test_checks(command: Callable[..., str], name: str, tmp_path: Path) -> None:
    path, readings = RECORDED / f"{name}.toml", RECORDED / f"{name}.csv"
    scene = tn.Scene.load(path)
    recording = scene.read(readings)
    check = recording.check(name=str(readings))
    said = command("check", path, "--readings", readings, "--json", tmp_path / "check.json")
    assert check.to_json() == (tmp_path / "check.json").read_text()
    assert str(check).splitlines()[1:] == said.splitlines()[1:] and check.understood
    turned = scene.check(-recording.readings)
    assert any("sign" in finding.what or "pull" in finding.what for finding in turned.findings), turned.findings
    assert all(finding.advice for finding in turned.findings) and "suspicious" in repr(turned)
    told = [{"kind": one.kind, "text": one.what, "advice": one.advice} | one.numbers for one in turned.findings]
    assert told == turned.to_dict()["findings"]
    assert all(one.numbers for one in turned.findings)


def test_frames_that_miss_readings(command: Callable[..., str], tmp_path: Path) -> None:
    path = RECORDED / "skin-pad.toml"
    skin = tn.Skin.load(path)
    recording = skin.read(RECORDED / "skin-pad.csv")
    gaps = recording.readings.copy()
    gaps[1, 8, 9, :] = np.nan
    with pytest.raises(tn.FrameError, match="frame 1: reading .* is nan"):
        skin.solve(gaps)
    skipped = skin.solve(gaps, missing="skip")
    whole = skin.solve(recording.readings)
    assert skipped.verdict.tolist()[1] == "missing" == skipped.data.tolist()[1] and np.isnan(skipped.tractions[1]).all()
    kept = [0, 2, 3, 4]
    assert np.array_equal(skipped.tractions[kept], whole.tractions[kept]) and not skipped.touching[1].any()
    assert np.isnan(skipped.wrench[1]).all() and any("misses readings" in note for note in skipped.notes)
    estimated = skin.solve(gaps, missing="estimate")
    dead = skin.replace({"dead_taxels": {"indices": [8 * skin.columns + 9]}})
    there = np.nan_to_num(gaps)
    assert np.array_equal(estimated.tractions[1], dead.solve(there).tractions[1])
    assert estimated.wrench[1, 0] == pytest.approx(whole.wrench[1, 0], abs=4 * estimated.wrench_deviation[1, 0])
    assert skipped.data.tolist()[0] != "not_judged" and skipped.peak != 1
    skipped.report(tmp_path / "out")
    skipped.save(tmp_path / "s.npz")
    again = tn.Solution.load(tmp_path / "s.npz")
    assert again.data.tolist() == skipped.data.tolist() and again.verdict.tolist() == skipped.verdict.tolist()
    with pytest.raises(ValueError, match="missing must be fail, skip or estimate"):
        skin.solve(gaps, missing="guess")  # type: ignore[arg-type]


def test_frames_that_share_an_alpha() -> None:
    skin = tn.Skin(
        sensor=tn.Sensor(rows=5, columns=5, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=2.5e-3)],
        time=tn.Timing(rate=100.0, frames=6),
        noise=tn.Noise(rms=20.0),
        units={},
    )
    alone, shared = skin.simulate().solve(), skin.simulate().solve(share_alpha=6)
    assert len(set(alone.alpha.tolist())) > len(set(shared.alpha[-1:].tolist())) == 1
    assert np.ptp(np.log(shared.alpha[2:])) < np.ptp(np.log(alone.alpha))
    with pytest.raises(ValueError, match="this scene gives one"):
        skin.replace({"reconstruct": {"alpha": 1e-6}}).simulate().solve(share_alpha=4)
    with pytest.raises(ValueError, match="at least one frame"):
        skin.simulate().solve(share_alpha=0)

"""`tn.calibrate` on the public logs: what the command says, bit by bit."""

from __future__ import annotations

import json
import pickle
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from conftest import PROJECT

import tactile_net as tn

LOGS = PROJECT / "scenes/calibration"


@pytest.mark.parametrize("name", ["rod-layer", "strain-rods", "no-loads", "one-place"])
def test_numbers_are_those_of_the_command(name: str, tmp_path: Path, command: Callable[..., Any]) -> None:
    log, scene = LOGS / f"{name}.csv", LOGS / f"{name}.toml"
    found = tn.calibrate(log, scene, next=2)
    command("calibrate", log, "--scene", scene, "--next", 2, "--json", tmp_path / "c.json", "-o", tmp_path / "theirs.toml")
    theirs = json.loads((tmp_path / "c.json").read_text())
    assert found.to_dict() == theirs
    assert found.parameters["depth"].value == theirs["parameters"]["depth"]["value"]
    assert [gain.sd for gain in found.gains] == [gain["sd"] for gain in theirs["gains"]]
    written = found.write(tmp_path / "ours.toml")
    assert (tmp_path / "ours.toml").read_bytes() == (tmp_path / "theirs.toml").read_bytes()
    depth = found.parameters["depth"]
    assert tomllib.loads(written.text)["sensor"]["depth"] == pytest.approx(depth.value, abs=2e-3 * depth.sd)
    assert len(found.next) == 2 and found.next[0].radius > 0.0


def test_a_skin_is_calibrated_as_the_command_does(tmp_path: Path, command: Callable[..., Any]) -> None:
    log, scene = LOGS / "skin-layer.csv", LOGS / "skin-layer.toml"
    found = tn.calibrate(log, scene, next=2)
    command("calibrate", log, "--scene", scene, "--next", 2, "--json", tmp_path / "c.json", "-o", tmp_path / "theirs.toml")
    assert found.to_dict() == json.loads((tmp_path / "c.json").read_text())
    written = found.write(tmp_path / "ours.toml")
    assert isinstance(written, tn.Skin)
    assert (tmp_path / "ours.toml").read_bytes() == (tmp_path / "theirs.toml").read_bytes()
    assert len(found.next) == 2 and all(press.position_z is not None for press in found.next)
    assert {press.shape for press in found.next} <= {"sphere", "punch", "cone"}
    assert all((press.radius is None) == (press.shape != "sphere") for press in found.next)
    assert found.next[1].unknown_then < found.next[0].unknown_then
    assert "contact radius" in found._repr_html_()


def test_a_skins_shift_is_found_and_told_best() -> None:
    scene = tn.Scene.parse((LOGS / "skin-balls.toml").read_text() + "\n[calibrate]\nshift_sd = 1.0\n")
    found = tn.calibrate(LOGS / "skin-balls.csv", scene, next=1, target="shift_z")
    for name in ("shift", "shift_z"):
        shift = found.parameters[name]
        assert shift.verdict == "identified" and shift.sd is not None
        assert abs(shift.value) < 4.0 * shift.sd
    assert found.next[0].unknown_then < (found.parameters["shift_z"].sd or 0.0)


def test_what_it_shows(tmp_path: Path) -> None:
    found = tn.calibrate(LOGS / "rod-layer.csv", tn.Scene.load(LOGS / "rod-layer.toml"))
    assert found.verdict == "ok" and found.parameters["youngs_modulus"].verdict == "not_identifiable"
    assert "Young's modulus has no effect" in str(found)
    assert "<table>" in found._repr_html_() and "depth" in found._repr_html_()
    assert "Gains" in Path(found.page(tmp_path / "page.html")).read_text()
    again = pickle.loads(pickle.dumps(found))
    assert again.to_json() == found.to_json()


def test_a_log_that_is_wrong_is_refused(tmp_path: Path) -> None:
    text = (LOGS / "rod-layer.csv").read_text().replace("cylinder", "ball")
    (tmp_path / "log.csv").write_text(text)
    with pytest.raises(tn.InputError) as caught:
        tn.calibrate(tmp_path / "log.csv", LOGS / "rod-layer.toml")
    assert len(caught.value.diagnostics) > 1
    with pytest.raises(ValueError, match="no parameter"):
        tn.calibrate(LOGS / "rod-layer.csv", LOGS / "rod-layer.toml", fixed=["colour"])

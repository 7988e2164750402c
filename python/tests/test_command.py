"""Python and the command say the same, bit by bit: one library answers both."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT, SCENES, SKINS
from numpy.typing import NDArray

import tactile_net as tn

RECORDED = PROJECT / "scenes/recorded"
RECORDINGS = [
    (RECORDED / "thin-pad.toml", RECORDED / "thin-pad.csv"),
    (RECORDED / "thick-pad.toml", RECORDED / "thick-pad.csv"),
    (RECORDED / "thin-pad-counts.toml", RECORDED / "thin-pad-counts.csv"),
]


def columns(path: Path) -> dict[str, list[str]]:
    with open(path, newline="") as file:
        head, *rows = csv.reader(file)
    return {name: [row[i] for row in rows] for i, name in enumerate(head)}


def numbers(path: Path, *named: str) -> NDArray[np.float64]:
    """The columns whose names begin so, a row a frame."""
    chosen = [values for name, values in columns(path).items() if name.startswith(named)]
    return np.array([[float(v) if v else np.nan for v in values] for values in chosen]).T


def values(path: Path) -> list[list[float | str]]:
    """What a CSV says: 0.0 is 0."""

    def value(cell: str) -> float | str:
        try:
            return float(cell)
        except ValueError:
            return cell

    with open(path, newline="") as file:
        return [[value(cell) for cell in row] for row in csv.reader(file)]


def without_times(value: Any) -> Any:
    """A document without what a clock has told."""
    if isinstance(value, dict):
        return {key: without_times(inner) for key, inner in value.items() if not key.endswith("seconds")}
    return [without_times(inner) for inner in value] if isinstance(value, list) else value


def same_page(ours: Path, theirs: Path) -> None:
    """Two folders of results, but for the line that says which command made them and what a clock has told."""

    def page(folder: Path) -> str:
        html = (folder / "report.html").read_text()
        html = re.sub(r"<p>Made by <code>[^<]*</code></p>\n", "", html)
        return re.sub(r">(?:-|[\d.]+ (?:ns|µs|ms|s))<|(?:took|simulated in) [\d.]+ \w+", "", html)

    assert {p.name for p in ours.iterdir()} == {p.name for p in theirs.iterdir()}
    for path in theirs.iterdir():
        if path.suffix == ".csv":
            assert values(ours / path.name) == values(path), path.name
    assert page(ours) == page(theirs)


def test_simulated_readings(command: Callable[..., str], shipped: Path, tmp_path: Path) -> None:
    command("simulate", shipped, "-o", tmp_path / "readings.csv", "--truth", tmp_path / "truth.csv")
    scene = tn.Scene.load(shipped)
    recording = scene.simulate()
    named = tuple(scene.channels)
    assert np.array_equal(
        scene.raw_numbers(recording.readings).reshape(len(recording), -1), numbers(tmp_path / "readings.csv", *named)
    )
    assert recording.truth is not None
    truth = numbers(tmp_path / "truth.csv", "normal", "tangential")
    assert np.array_equal(recording.truth.reshape(len(recording), -1), truth)


def test_results_of_run(command: Callable[..., str], shipped: Path, tmp_path: Path) -> None:
    command("run", shipped, "--json", tmp_path / "result.json", "--out", tmp_path / "theirs")
    expected = json.loads((tmp_path / "result.json").read_text())
    result = tn.run(tn.Scene.load(shipped))
    assert result.succeeded
    result.report(tmp_path / "ours")
    same_page(tmp_path / "ours", tmp_path / "theirs")
    theirs = json.loads((tmp_path / "theirs/result.json").read_text())
    assert without_times(json.loads((tmp_path / "ours/result.json").read_text())) == without_times(theirs)
    for name, answer in result.methods.items():
        assert answer.tractions is not None
        found = numbers(tmp_path / f"theirs/tractions-{name}.csv", "normal", "tangential")
        assert np.array_equal(answer.tractions.reshape(1, -1), found[-1:])
    if result.scene.timing is None:
        assert without_times(result.to_dict()) == without_times(expected)


@pytest.mark.parametrize(("scene", "readings"), RECORDINGS, ids=lambda path: path.name)
@pytest.mark.parametrize("method", ["tikhonov", "closed_form"])
def test_answers_to_a_recording(
    command: Callable[..., str], scene: Path, readings: Path, method: str, tmp_path: Path
) -> None:
    file, bands, theirs = tmp_path / "tractions.csv", tmp_path / "bands.csv", tmp_path / "theirs"
    command("solve", scene, "--readings", readings, "--method", method, "-o", file, "--uncertainty", bands)
    command("solve", scene, "--readings", readings, "--method", method, "--out", theirs)
    ours = tn.Scene.load(scene)
    solution = ours.read(readings).solve(method)
    rows = solution.tractions.reshape(len(solution), -1)
    assert np.array_equal(rows, numbers(file, "normal_", "tangential_"))
    # A solver made ready is of one alpha, whatever answers a recording.
    by_alpha = ours.replace({"reconstruct.answer": "alpha"}).read(readings).solve(method)
    assert np.array_equal(ours.solver(method)(ours.read(readings).readings), by_alpha.tractions)
    said = columns(bands)
    assert solution.verdict.tolist() == said["verdict"]
    assert np.array_equal(solution.alpha, [float(v) for v in said["alpha"]])
    assert np.array_equal(
        solution.deviation.reshape(rows.shape),
        numbers(bands, "deviation_", "normal_deviation_", "tangential_deviation_"),
    )
    assert np.array_equal(solution.normal_force_deviation, [float(v) for v in said["normal_force_deviation"]])
    assert np.allclose(solution.normal_force, [float(v) for v in said["normal_force"]], rtol=1e-13)
    solution.report(tmp_path / "ours", name=str(readings))
    same_page(tmp_path / "ours", theirs)
    documents = [json.loads((folder / "result.json").read_text()) for folder in (tmp_path / "ours", theirs)]
    for document in documents:  # a file has columns that nobody reads; an array has none
        del document["columns_ignored"]
    assert without_times(documents[0]) == without_times(documents[1])


@pytest.mark.parametrize("path", SKINS, ids=lambda path: path.name)
def test_skins(command: Callable[..., str], path: Path, tmp_path: Path) -> None:
    """What is simulated, and what `run` makes of it, on every scene of a skin."""
    scene = tn.Skin.load(path)
    command("simulate", path, "-o", tmp_path / "readings.csv", "--truth", tmp_path / "truth.csv")
    recording = scene.simulate()
    raw = scene._rows(scene.raw_numbers(recording.readings))[0]
    assert np.array_equal(raw, numbers(tmp_path / "readings.csv", *scene.channels))
    assert recording.truth is not None
    truth = numbers(tmp_path / "truth.csv", "normal", "tangential")
    assert np.array_equal(recording.truth.reshape(len(recording), -1), truth)
    if "contact" not in scene.to_dict():
        return
    command("run", path, "--out", tmp_path / "theirs")
    result = tn.run(scene)
    result.report(tmp_path / "ours")
    same_page(tmp_path / "ours", tmp_path / "theirs")
    documents = [json.loads((tmp_path / one / "result.json").read_text()) for one in ("ours", "theirs")]
    assert without_times(documents[0]) == without_times(documents[1])
    assert result.skin.tractions is not None
    found = numbers(tmp_path / "theirs/tractions.csv", "normal", "tangential_y", "tangential_z").T
    names = [name for name in columns(tmp_path / "theirs/tractions.csv") if name.startswith(("normal", "tangential"))]
    for values, component in zip(result.skin.tractions, ("normal", "tangential_y", "tangential_z")):
        assert np.array_equal(values.ravel(), found[names.index(component)])


@pytest.mark.parametrize("name", ["skin-pad", "skin-pad-uneven"])
def test_answers_to_a_recording_of_a_skin(command: Callable[..., str], name: str, tmp_path: Path) -> None:
    path, readings, theirs = RECORDED / f"{name}.toml", RECORDED / f"{name}.csv", tmp_path / "theirs"
    command("solve", path, "--readings", readings, "--out", theirs, "--uncertainty", tmp_path / "forces.csv")
    solution = tn.Skin.load(path).read(readings).solve()
    rows = solution.tractions.reshape(len(solution), -1)
    assert np.array_equal(rows, numbers(theirs / "tractions-of-frames.csv", "normal_", "tangential_"))
    said = columns(tmp_path / "forces.csv")
    table = solution.to_dataframe()
    assert table["verdict"].tolist() == said["verdict"]
    for column in said.keys() - {"t", "verdict"}:
        assert np.array_equal(table[column], [float(v) if v else np.nan for v in said[column]], equal_nan=True), column
    solution.report(tmp_path / "ours", name=str(readings))
    same_page(tmp_path / "ours", theirs)
    documents = [json.loads((folder / "result.json").read_text()) for folder in (tmp_path / "ours", theirs)]
    for document in documents:  # a file has columns that nobody reads; an array has none
        del document["columns_ignored"]
    assert without_times(documents[0]) == without_times(documents[1])


def test_missing_readings(command: Callable[..., str], tmp_path: Path) -> None:
    scene, text = RECORDED / "thin-pad.toml", (RECORDED / "thin-pad.csv").read_text().splitlines()
    cells = text[-1].split(",")
    cells[7] = ""
    readings = tmp_path / "gaps.csv"
    readings.write_text("\n".join([*text[:-1], ",".join(cells)]) + "\n")
    for missing in ("skip", "estimate"):
        file = tmp_path / f"{missing}.csv"
        command("solve", scene, "--readings", readings, "--missing", missing, "-o", file)
        solution = tn.Scene.load(scene).read(readings).solve(missing=missing)
        found = solution.tractions.reshape(len(solution), -1)
        assert np.array_equal(found, numbers(file, "normal_", "tangential_"), equal_nan=True)
        assert (solution.verdict[-1] == "missing") == (missing == "skip")
    with pytest.raises(tn.FrameError, match="is nan"):
        tn.Scene.load(scene).read(readings).solve()
    with pytest.raises(tn.InputError):
        tn.Scene.load(scene).read(readings, missing=False)


# A plan takes a tangential weight that is stated, and an alpha that something chooses.
PLANNED = [p for p in SCENES if p.parent.name not in ("calibration", "circuits") and not p.stem.endswith("-weights")]


@pytest.mark.parametrize("shipped", PLANNED, indirect=True, ids=str)
def test_plans(command: Callable[..., str], shipped: Path, tmp_path: Path) -> None:
    scene = tn.Scene.load(shipped)
    if shipped.parent == RECORDED:  # no contact: alpha is chosen on the frames
        readings = RECORDED / f"{shipped.stem.removesuffix('-contact')}.csv"
        plan = scene.plan(accuracy=1e-5, readings=scene.read(readings))
        asked = ["--readings", readings]
    else:
        plan, asked = scene.plan(accuracy=1e-5), []
    command("plan", shipped, *asked, "--accuracy", "1e-5", "-o", tmp_path / "pad.plan")
    assert plan.to_bytes() == (tmp_path / "pad.plan").read_bytes()
    assert tn.Plan.load(tmp_path / "pad.plan") == plan
    assert plan.y.shape == scene.y.shape and np.allclose(plan.y, scene.y, atol=1e-12)


@pytest.mark.parametrize("name", ["fingertip.toml", "two-strains.toml", "coarse/palm.toml", "recorded/thin-pad.toml"])
def test_surveys(command: Callable[..., str], name: str, tmp_path: Path) -> None:
    path = PROJECT / "scenes" / name
    scene = tn.Scene.load(path)
    noise = scene.to_dict().get("noise")
    traction = 1000.0 if noise and "contact" not in scene.to_dict() else None
    asked = [] if traction is None else ["--traction", traction]
    command("identify", path, *asked, "--json", tmp_path / "survey.json", "--out", tmp_path / "theirs")
    survey = scene.identify(traction=traction)
    assert survey.wavelengths["normal"] == survey.normal and survey.wavelengths["drag_along"] == survey.tangential
    assert len(survey.shares) == len(scene.channels) and "drag_across" not in survey.wavelengths
    assert survey.to_json() == (tmp_path / "survey.json").read_text()
    survey.report(tmp_path / "ours")
    same_page(tmp_path / "ours", tmp_path / "theirs")
    assert len(survey.table) > 5 and str(survey) in command("identify", path, *asked).replace("\n\n", "\n")


@pytest.mark.parametrize("path", [p for p in SCENES if p.parent.name == "circuits"], ids=lambda path: path.name)
def test_circuits(command: Callable[..., str], path: Path, tmp_path: Path) -> None:
    scene = tn.Scene.load(path)
    command("certify", path, "--json", tmp_path / "certificate.json", "--out", tmp_path / "theirs")
    certification = scene.certify()
    assert certification.to_json() == (tmp_path / "certificate.json").read_text()
    certification.report(tmp_path / "ours")
    same_page(tmp_path / "ours", tmp_path / "theirs")
    assert scene.netlist() == command("gen", path)
    # Op-amps of a lattice may be parts of two outputs, which nic does not take.
    other = "crossbar" if 'realization = "lattice"' in path.read_text() else "nic"
    assert scene.netlist(other) == command("gen", path, "--realization", other)
    assert certification.stability in str(certification)


def test_relaxations(command: Callable[..., str], tmp_path: Path) -> None:
    path = PROJECT / "scenes/nic.toml"
    relaxation = tn.Scene.load(path).relax()
    command("relax", path, "--json", tmp_path / "relaxation.json")
    theirs = json.loads((tmp_path / "relaxation.json").read_text())
    assert without_times(relaxation.to_dict()) == without_times(theirs)
    assert relaxation.agrees and relaxation.difference < 1e-6 and relaxation.realization in str(relaxation)
    direct = tn.Scene.load(path).simulate().solve().tractions[0]
    assert np.allclose(relaxation.tractions, direct, atol=1e-6 * np.abs(direct).max())
    assert relaxation.voltages.size == relaxation.tractions.size


def test_explanations(command: Callable[..., str], shipped: Path) -> None:
    said = command("run", shipped, "--explain").replace("--frame", "frame=")  # each names its own options
    assert tn.Scene.load(shipped).explain() == said


def test_explanations_of_skins(command: Callable[..., str]) -> None:
    path = PROJECT / "scenes/skins/sphere.toml"
    assert tn.Scene.load(path).explain() == command("run", path, "--explain")

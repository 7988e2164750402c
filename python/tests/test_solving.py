"""Readings into tractions: shapes, laws, and what is refused."""

from __future__ import annotations

import pickle
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import tactile_net as tn


def test_a_method_is_linear_and_a_row_does_not_know_the_others(two: tn.Scene) -> None:
    solver = two.solver(alpha=1e-3)
    matrix = solver(np.eye(42)).reshape(42, -1).T
    readings = two.simulate().readings
    tractions = solver(readings)
    assert tractions.shape == (5, 2, len(two.y))
    assert np.allclose(matrix @ readings[3].reshape(-1), tractions[3].reshape(-1), rtol=1e-12, atol=1e-9)
    for k, one in enumerate(readings):
        assert np.array_equal(solver(one), tractions[k])
    assert np.array_equal(solver(readings.reshape(5, -1)), tractions)
    assert np.array_equal(solver(readings.reshape(1, 5, 2, 21)), tractions[None])
    assert solver(readings[:0]).shape == (0, 2, len(two.y))


@given(
    depth=st.floats(0.5e-3, 4e-3),
    alpha=st.floats(1e-5, 1e-1),
    count=st.integers(2, 15),
    seed=st.integers(0, 2**32 - 1),
)
def test_the_answer_minimises_what_the_docs_say(depth: float, alpha: float, count: int, seed: int) -> None:
    scene = tn.Scene(
        sensor=tn.Sensor(count=count, pitch=0.5e-3, depth=depth, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        reconstruct=tn.Reconstruct(surface="taxels"),
    )
    readings = np.random.default_rng(seed).normal(size=scene.reading_shape)
    found = scene.solver(alpha=alpha)(readings).reshape(-1)
    wanted = np.linalg.solve(scene.normal_matrix(alpha), scene.kernel_matrix().T @ readings.reshape(-1))
    assert np.allclose(found, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


def test_methods_agree(scene: tn.Scene) -> None:
    readings = scene.simulate().readings
    assert np.allclose(scene.solver("closed_form")(readings), scene.solver()(readings), rtol=1e-9, atol=1e-6)
    with pytest.raises(ValueError, match="no method 'magic'"):
        scene.solver("magic")
    with pytest.raises(ValueError, match="circuit|network"):
        scene.solver("network")
    assert np.array_equal(
        pickle.loads(pickle.dumps(scene.solver(alpha=1e-2)))(readings), scene.solver(alpha=1e-2)(readings)
    )


def test_uneven_arrays(uneven: tn.Scene) -> None:
    recording = uneven.simulate()
    readings = len(uneven.reading_names)
    assert not uneven.even and recording.readings.shape == (1, readings)
    solution = recording.solve()
    assert solution.tractions.shape == (1, uneven.unknowns, len(uneven.y))
    assert np.all(np.diff(uneven.taxels) >= 0) and set(uneven.sites.quantity) == set(uneven.channels)
    estimator = tn.Estimator(uneven.plan(readings=recording))
    assert estimator.readings.shape == (readings,)
    assert estimator.update(recording.readings[0]).shape == uneven.plan(readings=recording).traction_shape


def test_a_solution_knows_how_sure_it_is(two: tn.Scene) -> None:
    recording = two.simulate()
    solution = recording.solve()
    assert recording.truth is not None
    assert solution.deviation.shape == solution.tractions.shape == recording.truth.shape
    inside = np.abs(solution.tractions - recording.truth) <= 2 * solution.deviation
    assert inside.mean() > 0.8
    assert np.all(np.abs(solution.tangential_force - 0.3) < 4 * solution.tangential_force_deviation + 0.02)
    assert np.all(np.abs(solution.normal_force - 1.0) < 4 * solution.normal_force_deviation + 0.02)
    assert np.all(np.abs(solution.centre) < 4 * solution.centre_deviation)
    for frame, contacts in enumerate(solution.patches):
        (contact,) = contacts  # the only one is the whole, and keeps its number
        whole = solution.normal_force[frame], solution.normal_force_deviation[frame]
        assert contact.id == 1 and contact.normal[:2] == pytest.approx(whole, rel=1e-9)
    tractions, full = two.solver()(recording.readings, full=True)
    assert np.array_equal(tractions, solution.tractions) and full.verdict.tolist() == solution.verdict.tolist()
    single, _ = two.solver()(recording.readings[0], full=True)
    assert single.shape == tractions[0].shape


def test_dft_knows_no_deviation(scene: tn.Scene) -> None:
    solution = scene.replace({"reconstruct": None}).simulate().solve("dft")
    assert not solution.has_bands and np.isnan(solution.tangential_force).all() and np.isnan(solution.alpha).all()
    with pytest.raises(ValueError, match="dft knows no deviation"):
        _ = solution.centre_deviation
    with pytest.raises(ValueError, match="dft knows no deviation"):
        _ = solution.patches


def test_a_solution_is_pickled_as_arrays(two: tn.Scene, tmp_path: Path) -> None:
    solution = two.simulate().solve()
    again = pickle.loads(pickle.dumps(solution))
    assert np.array_equal(again.tractions, solution.tractions) and again.notes == solution.notes
    assert np.array_equal(again.deviation, solution.deviation)
    again.report(tmp_path / "again")
    solution.report(tmp_path / "first")
    assert (tmp_path / "again/report.html").read_text() == (tmp_path / "first/report.html").read_text()
    assert "<svg" in again._repr_html_()


def test_a_report_spares_what_it_has_not_written(scene: tn.Scene, tmp_path: Path) -> None:
    (tmp_path / "report.html").write_text("somebody's own")
    solution = scene.simulate().solve()
    with pytest.raises(OSError, match="was not written by tactile-net"):
        solution.report(tmp_path)
    assert (tmp_path / "report.html").read_text() == "somebody's own"
    assert Path(solution.report(tmp_path, force=True)).read_text().startswith("<!DOCTYPE html>")


def test_frames_that_are_no_frames(scene: tn.Scene, frame: Any) -> None:
    solver = scene.solver()
    expected = solver(frame)
    for good in (
        np.asfortranarray(frame),
        np.repeat(frame, 2, axis=1)[:, ::2],
        frame.tolist(),
        frame.view(type("Mine", (np.ndarray,), {})),
    ):
        assert np.array_equal(solver(good), expected)
    assert np.allclose(solver(frame.astype(np.float32)), expected, rtol=1e-5, atol=1.0)
    assert np.array_equal(solver(np.ones(21, dtype=int)), solver(np.ones(21)))
    for bad, words in (
        (np.ma.masked_array(frame, frame > 0), "masked"),
        (frame.astype(object), "object"),
        (frame + 0j, "complex"),
        (np.array("pad"), "<U3"),
        (3.0, r"got \(\)"),
        (frame[:, :-1], r"\(1, 20\)"),
        (frame.T, r"\(21, 1\)"),
    ):
        with pytest.raises(ValueError, match=words):
            solver(bad)
    for value, words in ((np.nan, "reading 4 is nan"), (np.inf, "reading 4 is inf"), (-np.inf, "-inf")):
        spoiled = np.stack([frame, frame])
        spoiled[1, 0, 4] = value
        with pytest.raises(tn.FrameError, match=f"frame 1: .*{words}") as caught:
            solver(spoiled)
        assert caught.value.frame == 1
    with pytest.raises(tn.FrameError, match="overflow"):
        solver(np.full(21, 1e308))


def test_labelled_arrays_are_asked_for_their_dimensions(two: tn.Scene) -> None:
    xarray = pytest.importorskip("xarray")
    recording = two.simulate()
    labelled = recording.to_xarray()["readings"]
    assert np.array_equal(two.solver()(labelled), two.solver()(recording.readings))
    with pytest.raises(ValueError, match=r"end in the dimensions \(channel, taxel\)"):
        two.solver()(labelled.transpose("t", "taxel", "channel"))
    with pytest.raises(ValueError, match="dimensions"):
        two.solver()(xarray.DataArray(np.zeros((2, 21)), dims=("taxel", "channel")))
    pandas = pytest.importorskip("pandas")
    assert np.array_equal(two.solver()(recording.to_dataframe()), two.solver()(recording.readings))
    assert np.array_equal(two.solver()(pandas.Series(np.ones(42))), two.solver()(np.ones(42)))


def test_tables_carry_what_they_are_of(two: tn.Scene) -> None:
    pytest.importorskip("xarray")
    solution = two.simulate().solve()
    dataset = solution.to_xarray()
    assert tuple(dataset["tractions"].dims) == ("t", "component", "y")
    assert tn.Scene.parse(dataset.attrs["scene"]).to_dict() == two.to_dict()
    assert np.array_equal(dataset["truth"].sel(component="normal"), solution.recording.truth[:, 0])  # type: ignore[index]
    table = solution.to_dataframe()
    assert table.index.name == "t" and np.array_equal(table["normal_force"], solution.normal_force)


def test_errors_say_which_kind_they_are(scene: tn.Scene) -> None:
    with pytest.raises(ValueError, match="alpha"):
        scene.solver(alpha=-1.0)
    with pytest.raises(ValueError, match="missing must be"):
        scene.simulate().solve(missing="guess")
    with pytest.raises(ValueError, match="share|alpha"):
        scene.simulate().solve(share_alpha=3)
    strains = scene.replace({"sensor.reads": ["shear_xy"], "reconstruct": {"methods": ["dft"]}, "noise": None})
    with pytest.raises((tn.UnsolvableError, ValueError)):
        strains.solver("dft")


def test_other_threads_go_on_while_a_large_scene_is_solved(scene: tn.Scene) -> None:
    large = scene.replace({"sensor.count": 600, "reconstruct.alpha": 1e-4})
    readings = large.simulate().readings
    ticks = 0
    done = threading.Event()

    def tick() -> None:
        nonlocal ticks
        while not done.is_set():
            ticks += 1
            time.sleep(0.001)

    ticker = threading.Thread(target=tick)
    ticker.start()
    begin = time.perf_counter()
    large.solver()(readings)
    seconds = time.perf_counter() - begin
    done.set()
    ticker.join()
    assert seconds > 0.02 and ticks > 0.05 * seconds / 0.001


def test_threads_share_a_scene(two: tn.Scene) -> None:
    readings = two.simulate().readings
    expected = two.solver()(readings)
    answers: list[Any] = []

    def work() -> None:
        for _ in range(5):
            answers.append(two.solver()(readings))
            two.normal_matrix(1e-3)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 20 and all(np.array_equal(answer, expected) for answer in answers)


def test_a_solver_shows_its_matrix_without_a_copy(two: tn.Scene) -> None:
    solver = two.solver()
    matrix = solver.matrix
    assert matrix.shape == (2 * len(two.y), 42) and not matrix.flags.owndata and not matrix.flags.writeable
    assert np.shares_memory(matrix, solver.matrix)
    readings = two.simulate().readings[-1]
    assert matrix @ readings.ravel() == pytest.approx(solver(readings).ravel(), rel=1e-10, abs=1e-9)
    del solver
    assert np.isfinite(matrix).all(), "the view keeps its solver"


@pytest.mark.parametrize("method", ["tikhonov", "closed_form"])
def test_gradients_go_backwards_through_a_solver(two: tn.Scene, method: str) -> None:
    solver = two.solver(method)
    readings = two.simulate().readings
    weights = np.random.default_rng(1).normal(size=solver(readings).shape)
    gradient = solver.vjp(weights)
    assert gradient.shape == readings.shape
    step = np.random.default_rng(2).normal(size=readings.shape)
    change = ((solver(readings + step) - solver(readings - step)) / 2 * weights).sum()
    assert (gradient * step).sum() == pytest.approx(change, rel=1e-9)


def test_gradients_go_backwards_to_alpha(two: tn.Scene) -> None:
    readings = two.simulate().readings
    alpha, step = 1e-3, 1e-4
    up, down = (two.solver(alpha=alpha * np.exp(side * step))(readings) for side in (1, -1))
    found = two.solver(alpha=alpha).alpha_derivative(readings)
    assert found.shape == up.shape
    assert found == pytest.approx((up - down) / (2 * step), abs=1e-6 * np.abs(found).max())


def test_what_has_no_matrix_says_so(scene: tn.Scene) -> None:
    ruled = scene.replace({"reconstruct.alpha": "gcv"})
    for solver in (ruled.solver(), scene.solver("dft"), scene.replace({"reconstruct.nonnegative": True}).solver()):
        with pytest.raises(ValueError, match="the answer is not one matrix here"):
            solver.matrix
    with pytest.raises(ValueError, match=r"gradient must be of shape \(..., 1, 21\)"):
        scene.solver().vjp(np.zeros(20))


def test_a_mixture_has_intervals_that_hold_the_force() -> None:
    scene = tn.Scene(
        sensor=tn.Sensor(count=17, pitch=1e-3, depth=1e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        contacts=[tn.Cylinder(center=1.3e-3, half_width=1.1e-3, force=20.0)],
        noise=tn.Noise(rms=60.0),
        reconstruct=tn.Reconstruct(answer="mixture"),
    )
    solution = scene.simulate().solve()
    force = solution.interval("normal_force")
    assert force.shape == (1, 2) and force[0, 0] < 20.0 < force[0, 1]
    known = solution.distribution("normal_force")
    assert np.array_equal(known.interval(0.95), force)
    assert np.all(np.diff(known.quantile([0.1, 0.5, 0.9])) > 0.0)
    assert force[0, 0] < solution.interval("normal_force", 0.5)[0, 0]
    assert solution.interval("centre")[0, 0] < solution.centre[0] < solution.interval("centre")[0, 1]
    assert np.isnan(solution.interval("tangential_force")).all()
    with pytest.raises(ValueError, match="no distribution"):
        solution.interval("torsion")
    for level in (0.0, 1.0, -0.5, float("nan")):
        with pytest.raises(ValueError, match="level must be between 0 and 1"):
            solution.interval("normal_force", level)
    with pytest.raises(ValueError, match="between 0 and 1"):
        known.quantile([1.0])
    by_alpha = scene.replace({"reconstruct.answer": "alpha"}).simulate().solve()
    assert by_alpha.has_bands
    with pytest.raises(ValueError, match="one alpha"):
        by_alpha.interval("normal_force")


def test_a_verdict_knows_how_sure_the_force_is() -> None:
    scene = tn.Scene(
        sensor=tn.Sensor(count=17, pitch=1e-3, depth=1e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        contacts=[tn.Cylinder(force=5.0, half_width=1e-3)],
        noise=tn.Noise(rms=20.0),
    )
    recording = scene.simulate()
    assert scene.solve(recording).verdict.tolist() == ["ok"]
    two_live = scene.replace({"dead_taxels.indices": [i for i in range(17) if i not in (8, 9)]})
    found = two_live.solve(recording)
    low, high = found.interval("normal_force")[0]
    assert high - low > abs(found.normal_force[0])
    assert found.verdict.tolist() == ["undetermined"]
    again = pickle.loads(pickle.dumps(found))
    assert again.verdict.tolist() == ["undetermined"]

"""A skin in a control loop: plans, and the call of every frame, in rows and columns."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

import tactile_net as tn


@pytest.fixture
def frames(skin: tn.Skin) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    force = [{"t": 0.0, "force": 0.2}, {"t": 0.03, "force": 0.6, "place": [1e-3, 0.0]}]
    moving = skin.replace({"time": {"rate": 100.0, "frames": 4}, "contact.0.trajectory": force})
    return moving.simulate().readings


def test_every_way_gives_the_same_bits(skin: tn.Skin, frames: np.ndarray) -> None:
    plan = skin.plan()
    estimator = tn.Estimator(plan)
    places = skin.traction_shape
    assert plan.reading_shape == (6, 5, 3) and plan.traction_shape == (3, *places)
    assert estimator.readings.shape == (6, 5, 3) and estimator.tractions.shape == (3, *places)
    batch = estimator.update_batch(frames)
    assert batch.shape == (4, 3, *places)
    flat = skin._rows(frames)[0]
    assert np.array_equal(estimator.update_batch(flat), batch)
    out = np.empty((3, *places))
    for k, frame in enumerate(frames):
        assert np.array_equal(estimator.update(frame), batch[k]) and estimator.update(frame).shape == out.shape
        assert estimator.update(frame, out) is out and np.array_equal(out, batch[k])
        assert np.array_equal(estimator.update(np.ascontiguousarray(flat[k])), batch[k])
        estimator.readings[:] = frame
        estimator.step()
        assert np.array_equal(estimator.tractions, batch[k])
    # What the plan promises, of what `solver` computes without a plan.
    expected = skin.solver()(frames)
    assert np.linalg.norm(batch - expected) < 1e-6 * np.linalg.norm(expected)


def test_an_exchanged_frame_is_refused(skin: tn.Skin, frames: np.ndarray) -> None:
    estimator = tn.Estimator(skin.plan())
    frame, wanted = frames[0], r"frame must be of shape \(6, 5, 3\), rows, columns and channels, or \(90,\)"
    for wrong in (frame.transpose(2, 0, 1), frame.transpose(1, 0, 2), frame.reshape(30, 3)):
        with pytest.raises(ValueError, match=wanted):
            estimator.update(np.ascontiguousarray(wrong))
    with pytest.raises(ValueError, match="baseline must be of shape"):
        estimator.set_baseline(np.zeros((3, 6, 5)))
    with pytest.raises(ValueError, match=r"frames must be of shape \(..., 6, 5, 3\)"):
        estimator.update_batch(frames.transpose(0, 3, 1, 2))
    bad = frame.copy()
    bad[2, 3, 0] = np.nan
    with pytest.raises(tn.FrameError, match="reading 13 is nan"):
        estimator.update(bad)


def test_what_is_known_of_a_frame(skin: tn.Skin) -> None:
    still = skin.replace({"noise.seed": 3, "contact.0.torsion": 2e-4})
    estimator = tn.Estimator(still.plan(friction=0.9))
    recording = still.simulate()
    estimator.update(recording.readings[0])
    contact, solution = estimator.contact, still.solve(recording)
    assert contact.contact and contact.normal_force == pytest.approx(0.5, rel=0.1)
    found = (contact.tangential_y, contact.tangential_z, contact.centre, contact.centre_z, contact.torsion)
    off = np.abs(np.array(found) - solution.wrench[0, [1, 2, 3, 4, 5]]) / solution.wrench_deviation[0, [1, 2, 3, 4, 5]]
    assert off.max() < 4.0, off
    assert contact.tangential_force == pytest.approx(np.hypot(contact.tangential_y, contact.tangential_z))
    assert contact.friction_margin == pytest.approx(0.9 * contact.normal_force - contact.tangential_force)
    assert 0.0 < contact.slip_margin < 1.0 and 0 < contact.touching <= np.prod(skin.traction_shape)
    line = tn.Scene(
        sensor=tn.Sensor(count=9, pitch=1e-3, depth=1e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=1e5, poisson_ratio=0.45),
        reconstruct=tn.Reconstruct(alpha=1e-3),
    )
    of_line = tn.Estimator(line.plan())
    of_line.update(np.ones((1, 9)))
    assert np.isnan(of_line.contact.tangential_y) and np.isnan(of_line.contact.torsion) and of_line.contact.touching == 0


def test_baselines_and_dead_taxels(skin: tn.Skin, frames: np.ndarray) -> None:
    estimator = tn.Estimator(skin.plan(accuracy=1e-10))
    clean = estimator.update(frames[1])
    offset = np.random.default_rng(2).normal(size=frames[1].shape)
    estimator.set_baseline(offset)
    assert np.allclose(estimator.update(frames[1] + offset), clean, rtol=0, atol=1e-9 * np.abs(clean).max())
    assert estimator.baseline is not None and np.array_equal(estimator.baseline, skin._rows(offset)[0][0])
    estimator.set_dead(3 * 5 + 2)
    broken = frames[1] + offset
    broken[3, 2] = 1e6
    without = skin.replace({"dead_taxels": {"indices": [17]}}).solver()(frames[1])
    found = estimator.update(broken)
    assert np.linalg.norm(found - without) < 1e-5 * np.linalg.norm(without)
    for again in (pickle.loads(pickle.dumps(estimator)), copy.copy(estimator)):
        assert again.dead == (17,) and np.array_equal(again.update(broken), found)


def test_plans_of_skins_in_files(skin: tn.Skin, frames: np.ndarray, tmp_path: Path) -> None:
    symmetric, plain = skin.plan(), skin.plan(structure="dense")
    assert symmetric.structure.startswith("reflections") and plain.structure == "dense"
    assert np.allclose(plain.y, skin.y) and np.allclose(plain.z, skin.z)
    assert (plain.spacing, plain.spacing_z) == pytest.approx((skin.spacing, skin.spacing_z))
    for plan in (symmetric, plain):
        plan.save(tmp_path / "skin.plan")
        expected = tn.Estimator(plan).update(frames[0])
        known = tn.Plan.load(tmp_path / "skin.plan", scene=skin)
        for one in (known, pickle.loads(pickle.dumps(plan))):
            assert one == plan and one.reading_shape == (6, 5, 3)
            assert np.array_equal(tn.Estimator(one).update(frames[0]), expected)
        with pytest.raises(ValueError, match="the plan is not of 8 x 4 taxels"):
            tn.Plan.load(tmp_path / "skin.plan", scene=skin.replace({"sensor.rows": 8, "sensor.columns": 4}))
    # Which knows of rows and columns by its symmetry, and which by its scene alone.
    assert tn.Plan.from_bytes(symmetric.to_bytes()).reading_shape == (6, 5, 3)
    stranger = tn.Plan.from_bytes(plain.to_bytes())
    assert stranger.reading_shape == (90,) and stranger.traction_shape == plain.traction_shape
    flat = skin._rows(frames[0])[0][0]
    assert np.array_equal(tn.Estimator(stranger).update(flat), tn.Estimator(plain).update(frames[0]))
    with pytest.raises(ValueError, match=r"must be of shape \(90,\), .* Plan.load\(path, scene=skin\) does"):
        tn.Estimator(stranger).update(frames[0])


def test_taxels_anywhere_and_rules(skin: tn.Skin, tmp_path: Path) -> None:
    places = "".join(f"t{k},{y},{z},1.5e-3,stress_x shear_xy shear_xz\n" for k, (y, z) in enumerate(
        [(-2e-3, -2e-3), (0.0, -1e-3), (2e-3, -2e-3), (-1e-3, 1e-3), (1.5e-3, 0.5e-3), (0.0, 3e-3)]))
    (tmp_path / "palm.csv").write_text("name,y,z,depth,reads\n" + places)
    table = skin.to_dict() | {"sensor": {"taxels": "palm.csv"}, "reconstruct": {"alpha": "evidence"}}
    palm = tn.Skin.from_dict(table, file=str(tmp_path / "palm.toml"))
    plan = palm.plan(readings=palm.simulate())
    assert plan.reading_shape == (18,) and plan.alpha == palm.solve(palm.simulate()).alpha[0]
    frame = palm.simulate().readings[0]
    found = tn.Estimator(plan).update(frame)
    expected = palm.solver(alpha=plan.alpha)(frame)
    assert np.linalg.norm(found - expected) < 1e-6 * np.linalg.norm(expected)
    with pytest.raises(ValueError, match="pass readings="):
        palm.replace({"contact": None}).plan()


def test_counts_of_a_skin(skin: tn.Skin, frames: np.ndarray) -> None:
    """[calibration], a gain and an offset a reading: in files, plans and controllers as of line arrays."""
    rng = np.random.default_rng(4)
    gains, offsets = rng.uniform(0.5, 1.5, 90).round(3).tolist(), rng.normal(size=90).round(3).tolist()
    counts = skin.replace({"calibration": {"gains": gains, "offsets": offsets}})
    numbers = counts.raw_numbers(frames)
    assert np.allclose(skin._rows(numbers)[0], skin._rows(frames)[0] * gains + offsets, rtol=1e-12)
    plan = counts.plan()
    assert plan.for_raw_numbers and plan.structure != skin.plan().structure
    found, expected = tn.Estimator(plan).update_batch(numbers), skin.solver()(frames)
    assert np.linalg.norm(found - expected) < 1e-6 * np.linalg.norm(expected)
    alike = skin.replace({"calibration": {"gain": 0.25, "baseline": 512}})
    assert alike.plan().structure == skin.plan().structure, "one gain for all costs no symmetry"
    assert alike.replace({"calibration": {"baseline_frames": [0, 9]}}).plan().needs_baseline
    with pytest.raises(tn.InputError, match=r"one value per reading, channel after channel: 90 \(got 30\)"):
        skin.replace({"calibration": {"gains": gains[:30]}})


def test_counts_in_files(skin: tn.Skin, frames: np.ndarray, tmp_path: Path) -> None:
    gains = np.linspace(0.5, 1.5, 90).tolist()
    counts = skin.replace({"calibration": {"gains": gains, "offsets": -3.0}})
    np.save(tmp_path / "counts.npy", counts.raw_numbers(frames))
    assert np.allclose(counts.read(tmp_path / "counts.npy").readings, frames, rtol=1e-12)
    assert np.allclose(tn.load(tmp_path / "counts.npy", scene=counts, units="scene").readings, frames, rtol=1e-12)
    found = counts.read(tmp_path / "counts.npy").solve().tractions
    assert np.allclose(found, skin.solve(frames).tractions, rtol=0, atol=1e-9 * np.abs(found).max())


def test_frames_that_obey_constraints(skin: tn.Skin, tmp_path: Path) -> None:
    noisy = skin.replace({"noise": {"rms": 20.0}, "reconstruct.alpha": 1e-3})
    plan = noisy.plan(friction_limit=0.8)
    assert plan.friction_limit == 0.8 and 1 <= plan.steps <= 64
    median, high, worst = plan.unfinished
    assert 0.0 < median <= high <= worst and median < 1.0
    linear = noisy.plan()
    assert linear.friction_limit is None and linear.steps == 0
    estimator = tn.Estimator(plan)
    readings = noisy.simulate().readings[0]
    tractions = estimator.update(readings)
    pressure, drag = tractions[0], np.hypot(tractions[1], tractions[2])
    assert (pressure >= 0.0).all() and (drag <= 0.8 * pressure).all()
    contact = estimator.contact
    assert contact.steps == plan.steps and 0.0 < contact.unfinished < 1.0
    assert np.isnan(tn.Estimator(linear).contact.unfinished)
    estimator.set_work(steps=8)
    rough = estimator.update(readings)
    assert estimator.contact.steps == 8 and estimator.contact.unfinished > contact.unfinished
    assert np.array_equal(copy.copy(estimator).update(readings), rough)
    assert np.array_equal(pickle.loads(pickle.dumps(estimator)).update(readings), rough)
    estimator.set_work(steps=64, enough=1.0)
    estimator.update(readings)
    assert estimator.contact.steps < 64 and estimator.contact.unfinished <= 1.0
    plan.save(tmp_path / "cone.plan")
    assert np.array_equal(tn.Estimator(tn.Plan.load(tmp_path / "cone.plan", scene=noisy)).update(readings), tractions)
    with pytest.raises(ValueError, match="steps lead towards constraints"):
        noisy.plan(steps=3)
    with pytest.raises(ValueError, match="at most 64 steps"):
        noisy.plan(friction_limit=0.8, steps=65)
    with pytest.raises(ValueError, match="must be > 0"):
        noisy.plan(friction_limit=-0.8)
    with pytest.raises(ValueError, match="at most 64 steps"):
        estimator.set_work(steps=65)
    with pytest.raises(ValueError, match="no constraints"):
        tn.Estimator(linear).set_work(steps=3)


def test_contacts_one_by_one(skin: tn.Skin) -> None:
    noisy = skin.replace({"noise": {"rms": 20.0}})
    estimator = tn.Estimator(noisy.plan(), contacts=4)
    readings = noisy.simulate().readings[0]
    assert estimator.contacts == []
    estimator.update(readings)
    (one,) = estimator.contacts
    assert one.id == 1 and one.cells == estimator.contact.touching
    assert one.normal_force == pytest.approx(estimator.contact.normal_force)
    assert (one.centre, one.centre_z) == pytest.approx((estimator.contact.centre, estimator.contact.centre_z))
    estimator.update(np.zeros_like(readings))
    assert estimator.contacts == []
    estimator.update(readings)
    assert [row.id for row in estimator.contacts] == [1]
    assert copy.copy(estimator).most_contacts == 4
    assert tn.Estimator(noisy.plan()).contacts == []
    with pytest.raises(ValueError, match="at most 16 contacts"):
        tn.Estimator(noisy.plan(), contacts=17)

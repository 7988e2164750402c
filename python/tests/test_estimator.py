"""The call of a controller: the same bits by every way, and no frame that is not whole."""

from __future__ import annotations

import array
import copy
import gc
import os
import pickle
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import tactile_net as tn


@pytest.fixture
def estimator(scene: tn.Scene) -> tn.Estimator:
    return tn.Estimator(scene.plan(friction=0.5))


def test_every_way_gives_the_same_bits(two: tn.Scene) -> None:
    estimator = tn.Estimator(two.plan())
    frames = two.simulate().readings
    out = np.empty((2, 21))
    batch = estimator.update_batch(frames)
    assert batch.shape == (5, 2, 21)
    for k, frame in enumerate(frames):
        assert estimator.update(frame, out) is out
        assert np.array_equal(out, batch[k])
        assert np.array_equal(estimator.update(frame), out)
        estimator.readings[:] = frame
        estimator.step()
        assert np.array_equal(estimator.tractions, out)
        flat = np.empty(42)
        estimator.update(frame.reshape(-1), out=flat)
        assert np.array_equal(flat, out.reshape(-1))
    assert np.array_equal(estimator.update_batch(frames.reshape(5, -1)), batch)
    assert np.allclose(batch, two.solver()(frames), rtol=1e-6, atol=1e-3)


def test_what_is_known_of_a_frame(estimator: tn.Estimator, frame: Any, scene: tn.Scene) -> None:
    estimator.update(frame)
    contact = estimator.contact
    assert contact.contact and contact.normal_force == pytest.approx(1.0, rel=0.05)
    assert abs(contact.centre) < 1e-5 and np.isnan(contact.tangential_force)
    assert contact.outlier is None and not (contact.pulls or contact.misfit or contact.saturated or contact.implausible)
    spoiled = frame.copy()
    spoiled[0, 10] += 1e5
    estimator.update(spoiled)
    assert estimator.contact.outlier == 10 and estimator.contact.misfit
    assert contact.outlier is None, "a contact that was taken stays as it was"
    estimator.update(-frame)
    assert estimator.contact.pulls
    assert estimator.instruction_set in ("baseline", "avx2", "avx512")


def test_a_bad_frame_leaves_everything_as_it_was(estimator: tn.Estimator, frame: Any) -> None:
    out = np.full(21, 7.0)
    estimator.update(frame)
    before = estimator.contact.normal_force
    for value in (np.nan, np.inf, -np.inf):
        bad = frame.copy()
        bad[0, 3] = value
        with pytest.raises(tn.FrameError, match="reading 3 is"):
            estimator.update(bad, out)
    with pytest.raises(tn.FrameError, match="overflow"):
        estimator.update(np.full(21, 1e308), out)
    assert np.all(out == 7.0) and estimator.contact.normal_force == before
    frames = np.stack([frame] * 4)
    frames[2, 0, 0] = np.nan
    with pytest.raises(tn.FrameError, match="frame 2: reading 0 is nan") as caught:
        estimator.update_batch(frames)
    assert caught.value.frame == 2


WANTED = "must be a C-contiguous float64 array of 21, got "


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda f: f.astype(np.float32), r"float32 \(1, 21\)"),
        (lambda f: f.astype(">f8"), ">f8|float64"),
        (lambda f: f.astype(int), "int64"),
        (lambda f: f.astype(object), "object"),
        (lambda f: f[:, :-1], r"float64 \(1, 20\)"),
        (lambda f: np.repeat(f, 2, axis=1)[:, ::2], "float64"),
        (lambda f: f[0, 0], r"float64"),
        (lambda f: np.array(1.0), r"float64 \(\)"),
        (lambda f: f.tolist(), "list"),
        (lambda f: bytes(168), "bytes"),
        (lambda f: None, "NoneType"),
        (lambda f: np.ma.masked_array(f, f > 0), "mask"),
        (lambda f: np.frombuffer(bytes(169), dtype=np.uint8)[1:].view(np.float64), "float64"),
    ],
)
def test_frames_that_would_have_to_be_converted_are_refused(
    estimator: tn.Estimator, frame: Any, make: Any, words: str
) -> None:
    with pytest.raises(ValueError, match=f"frame {WANTED}.*{words}"):
        estimator.update(make(frame))
    if (out := make(np.zeros((1, 21)))) is not None:
        with pytest.raises(ValueError, match="out must be a writable C-contiguous float64 array of 21, got "):
            estimator.update(frame, out)


def test_fortran_order_is_told_from_the_other(two: tn.Scene) -> None:
    estimator = tn.Estimator(two.plan())
    frame = two.simulate().readings[0]
    with pytest.raises(ValueError, match="C-contiguous"):
        estimator.update(np.asfortranarray(frame))


def test_anything_that_is_such_memory_will_do(estimator: tn.Estimator, frame: Any) -> None:
    expected = estimator.update(frame)
    plain = array.array("d", frame.reshape(-1).tolist())
    assert np.array_equal(estimator.update(plain), expected)  # type: ignore[arg-type]
    assert np.array_equal(estimator.update(memoryview(plain)), expected)  # type: ignore[arg-type]
    mine = frame.view(type("Mine", (np.ndarray,), {}))
    assert np.array_equal(estimator.update(mine), expected)
    locked = frame.copy()
    locked.flags.writeable = False
    assert np.array_equal(estimator.update(locked), expected)
    with pytest.raises(ValueError, match="out must be a writable C-contiguous"):
        estimator.update(frame, out=locked)
    same = frame.copy()
    assert np.array_equal(estimator.update(same, out=same), expected), "out may be the frame's own memory"


def test_views_outlive_whoever_names_the_estimator(scene: tn.Scene, frame: Any) -> None:
    estimator = tn.Estimator(scene.plan())
    readings, tractions = estimator.readings, estimator.tractions
    readings[:] = frame
    estimator.step()
    expected = tractions.copy()
    del estimator
    gc.collect()
    junk = [np.zeros(21) for _ in range(1000)]
    assert np.array_equal(tractions, expected) and np.array_equal(readings, frame) and junk


def test_baseline_and_dead_taxels(scene: tn.Scene, frame: Any) -> None:
    estimator = tn.Estimator(scene.plan(accuracy=1e-12))
    clean = estimator.update(frame)
    offset = np.linspace(1.0, 2.0, 21)
    estimator.set_baseline(offset)
    assert np.allclose(estimator.update(frame + offset), clean, rtol=1e-9, atol=1e-6)
    assert estimator.baseline is not None and np.array_equal(estimator.baseline, offset)
    estimator.set_dead(4)
    broken = frame + offset
    broken[0, 4] = np.nan
    wanted = scene.replace({"dead_taxels": {"indices": [4]}}).solver()(np.where(np.isnan(broken), 0.0, broken - offset))
    assert np.allclose(estimator.update(broken), wanted, rtol=1e-6, atol=1e-3)
    assert estimator.dead == (4,)
    for again in (pickle.loads(pickle.dumps(estimator)), copy.copy(estimator), copy.deepcopy(estimator)):
        assert again.dead == (4,) and np.array_equal(again.update(broken), estimator.update(broken))
    estimator.revive()
    assert estimator.dead == () and np.allclose(estimator.update(frame + offset), clean, rtol=1e-9, atol=1e-6)
    with pytest.raises(ValueError, match="taxel 21 cannot be left out"):
        estimator.set_dead(21)
    with pytest.raises(TypeError):
        estimator.set_dead(-1)
    with pytest.raises(tn.FrameError):
        estimator.set_baseline(np.full(21, np.nan))
    with pytest.raises(ValueError, match="diagnostics"):
        tn.Estimator(scene.plan(diagnostics=False)).set_dead(3)


def test_one_estimator_is_for_one_thread(scene: tn.Scene) -> None:
    estimator = tn.Estimator(scene.plan())
    many = np.ones((400_000, 1, 21))
    begun, refused = threading.Event(), 0

    def work() -> None:
        begun.set()
        estimator.update_batch(many)

    worker = threading.Thread(target=work)
    worker.start()
    begun.wait()
    while worker.is_alive():
        try:
            estimator.step()
        except RuntimeError as error:
            assert "at work in another thread" in str(error)
            refused += 1
    worker.join()
    assert refused > 0
    estimator.step()


def test_an_estimator_works_after_a_fork(estimator: tn.Estimator, frame: Any) -> None:
    expected = estimator.update(frame)
    child = os.fork()
    if child == 0:
        os._exit(0 if np.array_equal(estimator.update(frame), expected) else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_plans_say_what_they_are(scene: tn.Scene, tmp_path: Path) -> None:
    plan = scene.plan(accuracy=1e-3)
    assert plan.reading_shape == (1, 21) and plan.traction_shape == (1, 21) and plan.alpha == 1e-3
    assert plan.error_bound <= plan.accuracy == 1e-3 and plan.structure in plan.why and plan.diagnostics
    assert np.allclose(plan.y, scene.y) and plan.spacing == scene.spacing and plan.streamed_bytes > 0
    plan.save(tmp_path / "pad.plan")
    loaded = tn.Plan.load(tmp_path / "pad.plan")
    assert loaded == plan and hash(loaded) == hash(plan) and loaded.why == ""
    assert pickle.loads(pickle.dumps(plan)).why == plan.why
    assert plan.structure in plan._repr_html_()
    assert (
        scene.plan(structure="dense").structure == "dense"
        and scene.plan(precision="float32", accuracy=1.0).precision == "float32"
    )
    fft = scene.plan(structure="fft")
    frame = scene.simulate().readings[0]
    assert np.allclose(tn.Estimator(fft).update(frame), scene.solver()(frame), rtol=1e-6, atol=1e-2)
    with pytest.raises(ValueError, match="no structure 'sparse': dense, low_rank"):
        scene.plan(structure="sparse")
    with pytest.raises(ValueError, match="accuracy"):
        scene.plan(accuracy=0.0)
    ruled = scene.replace({"contact": None, "reconstruct": None})
    with pytest.raises(ValueError, match="pass readings="):
        ruled.plan()
    assert ruled.plan(readings=scene.simulate()).alpha > 0


def test_plans_for_raw_numbers(scene: tn.Scene) -> None:
    counts = scene.replace({"calibration": {"gain": 0.25, "baseline": 512}})
    plan = counts.plan()
    readings = counts.simulate().readings
    assert plan.for_raw_numbers and not scene.plan().for_raw_numbers and not plan.needs_baseline
    found = tn.Estimator(plan).update_batch(counts.raw_numbers(readings))
    assert np.allclose(found, counts.solver()(readings), rtol=1e-6, atol=1e-3)
    assert counts.replace({"calibration": {"gain": 0.25, "baseline_frames": [0, 9]}}).plan().needs_baseline


@given(st.binary())
def test_any_bytes_are_a_plan_or_an_error(content: bytes) -> None:
    with pytest.raises(ValueError):
        tn.Plan.from_bytes(content)


BYTES = (
    tn.Scene(
        sensor=tn.Sensor(count=5, pitch=1e-3, depth=1e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=1e5, poisson_ratio=0.45),
        reconstruct=tn.Reconstruct(alpha=1e-3),
    )
    .plan()
    .to_bytes()
)


@given(st.integers(0, len(BYTES) - 1), st.integers(1, 255))
def test_a_flipped_byte_is_found(place: int, flip: int) -> None:
    spoiled = bytearray(BYTES)
    spoiled[place] ^= flip
    with pytest.raises(ValueError):
        tn.Plan.from_bytes(bytes(spoiled))
    with pytest.raises(ValueError):
        tn.Plan.from_bytes(BYTES[:place])


def test_files_that_are_no_plans(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        tn.Plan.load(tmp_path / "pad.plan")
    (tmp_path / "pad.plan").write_bytes(b"pad")
    with pytest.raises(ValueError, match="pad.plan: "):
        tn.Plan.load(tmp_path / "pad.plan")

"""Logs of skins: images of rows and columns, a channel for each quantity, and the wrench of what touches."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tactile_net as tn

pytest.importorskip("mcap.writer")
pytest.importorskip("rosbags.typesys")


def skin(*reads: str, **more: Any) -> tn.Skin:
    return tn.Skin(
        sensor=tn.Sensor(rows=5, columns=4, pitch=2e-3, depth=2e-3, reads=list(reads) or ["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=2.5e-3, place=[0.5e-3, -0.4e-3], friction=0.4, direction=30.0)],
        time=tn.Timing(rate=100.0, frames=3),
        noise=tn.Noise(rms=10.0),
        units={},
        **more,
    )


@pytest.mark.parametrize("reads", [(), ("stress_x",), ("displacement_x", "displacement_y")], ids=len)
def test_what_is_written_comes_back(reads: tuple[str, ...], tmp_path: Path) -> None:
    scene = skin(*reads)
    recording = scene.simulate()
    for what in (recording, recording.solve()):
        tn.logs.write(tmp_path / "skin.mcap", what, topic="/skin")
        again = tn.logs.read(tmp_path / "skin.mcap")
        assert again.readings.shape == (3, 5, 4, len(scene.channels)) and again.scene.text == scene.text
        assert again.readings.tobytes() == recording.readings.tobytes()
        assert recording.truth is not None and again.truth is not None and again.t is not None and recording.t is not None
        assert np.array_equal(again.truth, recording.truth) and np.array_equal(again.t, recording.t)
    blocks = list(tn.logs.blocks(tmp_path / "skin.mcap", frames=2))
    assert np.array_equal(np.concatenate([block.readings for block in blocks]), recording.readings)
    recording.save(tmp_path / "half.mcap", dtype=np.float32)
    assert np.array_equal(tn.load(tmp_path / "half.mcap").readings, recording.readings.astype(np.float32))


def test_what_viewers_see(tmp_path: Path) -> None:
    solution = skin().simulate().solve()
    tn.logs.write(tmp_path / "skin.mcap", solution, topic="/skin")
    images = [one.values for one in tn.logs.messages(tmp_path / "skin.mcap", topic="/skin")]
    assert np.array_equal(images, solution.recording.readings)
    fields = [one.values for one in tn.logs.messages(tmp_path / "skin.mcap", topic="/skin/tractions")]
    assert np.array_equal(np.moveaxis(fields, -1, 1), solution.tractions)
    with pytest.raises(tn.InputError, match="has tractions, not readings"):
        tn.logs.read(tmp_path / "skin.mcap", topic="/skin/tractions")


def test_the_wrench_is_that_of_the_solution(tmp_path: Path) -> None:
    solution = skin().replace({"contact.0.torsion": 2e-4}).simulate().solve()
    assert isinstance(solution, tn.SkinSolution)
    tn.logs.write(tmp_path / "skin.mcap", solution)
    found = np.array(
        [
            [one.values for one in tn.logs.messages(tmp_path / "skin.mcap", topic="/pad/contact", field=f"wrench.{of}.{axis}")]
            for of in ("force", "torque")
            for axis in "xyz"
        ]
    ).T
    p, q_y, q_z, y, z, torsion = solution.wrench[:, :6].T
    # About the middle of the skin: the torsion, and the force where it acts.
    expected = np.stack([p, q_y, q_z, torsion + y * q_z - z * q_y, z * p, -y * p], axis=1)
    assert np.allclose(found, expected, rtol=1e-9, atol=1e-12) and (found[:, 0] > 0.4).all()


def test_taxels_anywhere(tmp_path: Path) -> None:
    places = "name,y,z,depth,reads\nt0,-2e-3,-2e-3,2e-3,stress_x shear_xy\nt1,2e-3,-1e-3,2e-3,stress_x\nt2,0,2e-3,1e-3,stress_x\n"
    (tmp_path / "palm.csv").write_text(places)
    table = skin().to_dict() | {"sensor": {"taxels": "palm.csv"}, "reconstruct": {"alpha": 1e-6}}
    palm = tn.Skin.from_dict(table, file=str(tmp_path / "palm.toml"))
    recording = palm.simulate()
    recording.solve().save(tmp_path / "palm.mcap")
    again = tn.load(tmp_path / "palm.mcap")
    assert again.readings.shape == (3, 4) and again.readings.tobytes() == recording.readings.tobytes()
    assert again.truth is not None and recording.truth is not None and np.array_equal(again.truth, recording.truth)


def test_drivers_of_skins(tmp_path: Path) -> None:
    """Of others: an image of several channels, one of one, a flat list; what does not fit is refused with both shapes."""
    from tactile_net.logs._log_writer import LogWriter

    three, one = skin(), skin("stress_x")
    readings = three.simulate().readings
    with LogWriter(str(tmp_path / "a.mcap"), "hand", {}, ["/three", "/one", "/turned"]) as log:
        for k, frame in enumerate(readings.astype(np.float32)):
            log.image("/three", k, k, frame)
            log.image("/one", k, k, np.ascontiguousarray(frame[..., 0]))
            log.image("/turned", k, k, np.ascontiguousarray(frame.transpose(1, 0, 2)))
    path = tmp_path / "a.mcap"
    assert np.array_equal(tn.logs.read(path, topic="/three", scene=three, units="SI").readings, readings.astype(np.float32))
    alone = tn.logs.read(path, topic="/one", scene=one, units="SI").readings
    assert np.array_equal(alone, readings[..., :1].astype(np.float32))
    for topic, scene in (("/turned", three), ("/three", one), ("/one", three)):
        with pytest.raises(tn.InputError, match=topic):
            tn.logs.read(path, topic=topic, scene=scene, units="SI")

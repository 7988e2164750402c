"""Skins: the same calls, arrays in rows and columns, tractions in three directions."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT, SKINS

import tactile_net as tn

SPHERE = PROJECT / "scenes/skins/sphere.toml"
UNEVEN = PROJECT / "scenes/skins/palm.toml"


def moving(skin: tn.Skin) -> tn.Skin:
    return skin.replace(
        {
            "time": {"rate": 100.0, "frames": 4},
            "contact.0.trajectory": [{"t": 0.0, "force": 0.2}, {"t": 0.03, "force": 0.6, "place": [1e-3, 0.0]}],
        }
    )


def test_a_mesh_is_the_surface_of_a_skin() -> None:
    skin = tn.Skin.load(PROJECT / "scenes/skins/mesh-finger.toml")
    surface = skin.surface
    assert surface is not None and skin.positions is not None and skin.normals is not None
    assert len(surface.middles) == len(skin.y) * len(skin.z)
    # Places are on the mesh, within what its triangles leave between its vertices.
    lines = (PROJECT / "scenes/skins/mesh-finger.obj").read_text().splitlines()
    vertices = 1e-3 * np.array([line.split()[1:] for line in lines if line.startswith("v ")], dtype=float)
    for place in skin.positions:
        assert np.linalg.norm(vertices - place, axis=1).min() < 0.7e-3
    # The pressure of 1 Pa on each cell is minus its area along its normal.
    assert np.allclose(np.linalg.norm(skin.normals, axis=1), 1.0)
    assert np.allclose(np.linalg.norm(surface.forces[:, 0], axis=1), surface.areas, rtol=1e-2)
    assert np.allclose(np.einsum("ni,ni->n", surface.forces[:, 0], surface.frames[:, 0]), surface.areas, rtol=1e-2)


@pytest.mark.parametrize("path", SKINS, ids=lambda path: path.name)
def test_every_shipped_skin_survives_a_dictionary(path: Path) -> None:
    scene = tn.Scene.load(path)
    assert isinstance(scene, tn.Skin)
    again = tn.Scene.from_dict(scene.to_dict(), file=scene.file)
    assert isinstance(again, tn.Skin) and str(again) == str(scene)
    readings = int(np.prod(scene.reading_shape))
    assert len(scene.reading_names) == readings == len(scene.sites.z)
    assert np.array_equal(scene.taxels[scene.sites.taxel], np.stack([scene.sites.y, scene.sites.z], axis=1))
    assert scene.traction_shape == (len(scene.y), len(scene.z))
    assert np.allclose(np.diff(scene.y), scene.spacing) and np.allclose(np.diff(scene.z), scene.spacing_z)
    assert scene.even == (scene.reading_shape == (scene.rows, scene.columns, len(scene.channels)))
    assert scene.title.split()[0] in scene._repr_html_()


def test_dataclasses_and_files_of_skins_say_the_same(skin: tn.Skin) -> None:
    text = """
        [sensor]
        rows = 6
        columns = 5
        pitch = [2e-3, 1.5e-3]
        depth = 2e-3
        reads = ["stress_x", "shear_xy", "shear_xz"]
        [material]
        youngs_modulus = 0.25e6
        poisson_ratio = 0.48
        [[contact]]
        shape = "sphere"
        force = 0.5
        radius = 2.5e-3
        place = [0.5e-3, -0.4e-3]
        friction = 0.4
        direction = 30.0
        [noise]
        rms = 10.0
        [reconstruct]
        alpha = 1e-6
        [units]
    """
    assert np.array_equal(tn.Scene.parse(text).simulate().readings, skin.simulate().readings)
    assert isinstance(pickle.loads(pickle.dumps(skin)), tn.Skin) and pickle.loads(pickle.dumps(skin)) == skin


@pytest.mark.parametrize(
    "contact",
    [
        tn.Ellipsoid(force=0.5, radii=[3e-3, 1.5e-3], angle=20.0),
        tn.CircularPunch(force=0.5, radius=2e-3),
        tn.Cone(force=0.5, radius=2e-3, place=[1e-3, 0.0]),
        tn.TractionPatch(spacing=1e-3, normal=np.full((2, 3), 0.5 / 6e-6), place=[0.0, 0.5e-3]),
    ],
    ids=lambda contact: contact.shape,
)
def test_every_shape_presses_with_its_force(skin: tn.Skin, contact: Any) -> None:
    scene = skin.replace({"contact.0": contact})
    recording = scene.simulate()
    assert recording.truth is not None
    assert scene.cell_area * recording.truth[0, 0].sum() == pytest.approx(0.5, rel=1e-9)
    solution = recording.solve()
    assert abs(solution.normal_force[0] - 0.5) < 6 * solution.normal_force_deviation[0] + 0.05


def test_readings_stand_in_rows_and_columns_with_their_channels_last(skin: tn.Skin) -> None:
    recording = skin.simulate()
    assert recording.readings.shape == (1, 6, 5, 3)
    rows, lead = skin._rows(recording.readings)
    assert lead == (1,)
    for k, name in enumerate(skin.reading_names):
        *channel, row, column = name.split("_")
        at = skin.channels.index("_".join(channel))
        assert rows[0, k] == recording.readings[0, int(row), int(column), at], name
    assert np.array_equal(skin._framed(rows), recording.readings)
    # A sphere to the right of the middle and above it: so are the readings' and the answer's peaks.
    pressure = recording.readings[0, :, :, 0]
    assert np.unravel_index(pressure.argmax(), pressure.shape) in [(3, 2), (2, 2), (3, 1)]
    solution = skin.solve(recording)
    assert solution.normal.shape == (1, *skin.traction_shape)
    assert solution.centre[0] == pytest.approx([0.5e-3, -0.4e-3], abs=6 * float(solution.centre_deviation[0].max()))


def test_shapes_that_are_solved_and_shapes_that_are_not(skin: tn.Skin) -> None:
    readings = moving(skin).simulate().readings
    solver = skin.solver()
    found = solver(readings)
    assert found.shape == (4, 3, *skin.traction_shape)
    flat = skin._rows(readings)[0]
    assert np.array_equal(solver(flat), found)
    assert np.array_equal(solver(readings[2]), found[2])
    assert np.array_equal(solver(readings.reshape(2, 2, 6, 5, 3)).reshape(found.shape), found)
    assert np.array_equal(skin.solve(readings).tractions, found)
    assert np.array_equal(skin.solve(flat).tractions, found)
    for wrong in (readings.transpose(0, 3, 1, 2), readings[..., :2], np.zeros((4, 89))):
        with pytest.raises(ValueError, match=r"must be of shape \(\.\.\., 6, 5, 3\) or \(\.\.\., 90\)"):
            solver(wrong)
    bad = readings.copy()
    bad[1, 2, 3, 0] = np.nan
    for call in (solver, skin.solve, skin.replace({"reconstruct.alpha": "evidence"}).solver()):
        with pytest.raises(tn.FrameError, match="frame 1: reading 13 is nan") as caught:
            call(bad)
        assert caught.value.frame == 1


def test_a_solver_of_a_skin_is_its_matrix(skin: tn.Skin) -> None:
    readings = skin.simulate().readings
    solver = skin.solver()
    tractions = solver(readings)
    matrix = solver.matrix
    assert matrix.shape == (tractions.size, 90) and not matrix.flags.writeable
    rows = skin._rows(readings)[0]
    assert np.allclose((rows @ matrix.T).reshape(tractions.shape), tractions, atol=1e-10 * np.abs(tractions).max())
    gradient = np.random.default_rng(1).normal(size=tractions.shape)
    back = solver.vjp(gradient)
    assert back.shape == readings.shape
    assert np.vdot(gradient, tractions) == pytest.approx(np.vdot(back, readings), rel=1e-9)
    step = 1e-5
    up, down = (skin.solver(alpha=1e-6 * np.exp(s))(readings) for s in (step, -step))
    difference = (up - down) / (2 * step)
    assert np.allclose(solver.alpha_derivative(readings), difference, atol=1e-6 * np.abs(difference).max())
    kernel, normal = skin.kernel_matrix(), skin.normal_matrix(1e-6)
    assert kernel.shape == (90, tractions.size)
    # P f = K' g, which says that f is the minimiser: sizes of rounding, with P's condition squared in.
    right = kernel.T @ rows[0]
    assert np.abs(normal @ tractions.ravel() - right).max() < 1e-9 * np.abs(right).max()
    assert np.allclose(pickle.loads(pickle.dumps(solver))(readings), tractions, rtol=0, atol=0)
    for scene in (skin.replace({"reconstruct.alpha": "evidence"}), skin.replace({"reconstruct.nonnegative": True})):
        with pytest.raises(ValueError, match="not one matrix"):
            scene.solver().matrix
        full = scene.solver()(readings)
        assert np.array_equal(full, scene.solve(readings).tractions)


def test_a_solution_of_a_skin_is_in_balance(skin: tn.Skin) -> None:
    scene = skin.replace({"noise.rms": 20.0, "contact.0.torsion": 2e-4, "reconstruct.alpha": "evidence"})
    solution = scene.simulate().solve()
    assert solution.verdict[0] == "ok"
    true = [0.5, 0.2 * np.cos(np.pi / 6), 0.2 * np.sin(np.pi / 6), 0.5e-3, -0.4e-3, 2e-4]
    off = np.abs(solution.wrench[0, :6] - true)
    assert (off < 5 * solution.wrench_deviation[0, :6] + 0.03 * np.abs(true)).all(), off / solution.wrench_deviation[0, :6]
    # Sums over the cells that touch, of what is told of each cell.
    cells = np.where(solution.touching, solution.normal, 0.0)
    assert solution.normal_force[0] == pytest.approx(scene.cell_area * cells.sum(), rel=1e-12)
    moment = scene.cell_area * (cells[0].sum(axis=1) @ scene.y)
    assert solution.centre[0, 0] == pytest.approx(moment / solution.normal_force[0], rel=1e-9)
    covariance = solution.wrench_covariance[0]
    assert np.allclose(covariance, covariance.T, rtol=1e-9) and np.linalg.eigvalsh(covariance).min() > -1e-12
    assert np.allclose(np.sqrt(np.diag(covariance)), solution.wrench_deviation[0, :6], rtol=1e-12)
    assert solution.deviation.shape == solution.tractions.shape and (solution.deviation > 0).all()
    assert solution.friction[0] == pytest.approx(np.hypot(*solution.tangential_force[0]) / solution.normal_force[0])
    assert solution.contacts.tolist() == [1] and solution.ellipse.shape == (1, 3)
    ((contact,),) = solution.patches
    assert contact.id == 1 and contact.ellipse is not None and contact.ellipse.radius[:2] == (solution.ellipse[0, 0], solution.ellipse_deviation[0, 0])
    assert contact.normal[:2] == (solution.normal_force[0], solution.normal_force_deviation[0])
    assert contact.cells == tuple(np.flatnonzero(solution.touching[0]))
    assert len(tn.run(scene).skin.patches) == 1
    assert solution.torsion_deviation.shape == solution.friction_deviation.shape == (1,)


def test_a_mirrored_contact_has_a_mirrored_answer(skin: tn.Skin) -> None:
    scene = skin.replace({"noise": None})
    mirrored = scene.replace({"contact.0.place": [-0.5e-3, -0.4e-3], "contact.0.direction": 150.0})
    one, other = (s.simulate().solve().tractions[0] for s in (scene, mirrored))
    assert np.allclose(other[:, ::-1], one * np.array([1.0, -1.0, 1.0])[:, None, None], atol=1e-9 * np.abs(one).max())


def test_a_skin_answered_by_its_mixture_has_intervals_at_any_level(skin: tn.Skin) -> None:
    scene = moving(skin).replace({"reconstruct.alpha": None, "reconstruct.answer": "mixture", "report.level": 0.8})
    assert isinstance(scene, tn.Skin)
    solution = scene.simulate().solve()
    frame = 2
    resultant = tn.run(scene, frame=frame).told.reconstructions[0].resultant
    assert resultant.normal.interval.level == 0.8
    for what, ends in {
        "normal_force": [resultant.normal],
        "tangential_force": [resultant.tangential_y, resultant.tangential_z],
        "centre": list(resultant.centre),
    }.items():
        known = solution.distribution(what)
        value = getattr(solution, what)
        wide, narrow = solution.interval(what), known.interval(0.5)
        assert wide.shape == (*value.shape, 2) == narrow.shape
        assert np.all((wide[..., 0] < value) & (value < wide[..., 1]))
        assert np.all((wide[..., 0] < narrow[..., 0]) & (narrow[..., 1] < wide[..., 1]))
        assert np.array_equal(known.quantile([0.25, 0.75]), narrow)
        # The command says the same at the scene's level.
        said = [[one.interval.low, one.interval.high] for one in ends]
        assert solution.interval(what, 0.8)[frame].reshape(-1, 2) == pytest.approx(np.array(said), rel=1e-9)
    truth = scene.cell_area * solution.recording.truth[:, 0].sum(axis=(1, 2))  # type: ignore[index]
    low, high = solution.interval("normal_force", 0.99).T
    assert np.all((low < truth) & (truth < high))

    held = solution.interval("normal_force")
    assert np.array_equal(pickle.loads(pickle.dumps(solution)).interval("normal_force"), held)
    readings = solution.recording.readings.copy()
    readings[1, 0, 0] = np.nan
    skipped = scene.solve(readings, missing="skip")
    assert np.isnan(skipped.interval("centre")[1]).all()
    assert np.allclose(np.delete(skipped.interval("normal_force"), 1, axis=0), np.delete(held, 1, axis=0), rtol=1e-9)
    alone = scene.replace({"sensor.reads": ["stress_x"], "contact.0.friction": 0.0}).simulate().solve()
    assert np.isnan(alone.interval("tangential_force")).all()
    assert alone.interval("tangential_force").shape == (4, 2, 2)


def test_what_a_skin_has_no_interval_of_it_says(skin: tn.Skin) -> None:
    by_mixture = skin.replace({"reconstruct.alpha": None, "reconstruct.answer": "mixture"}).simulate().solve()
    for what in ("torsion", "friction", "wrench"):
        with pytest.raises(ValueError, match=f'"{what}" has no distribution'):
            by_mixture.interval(what)
    for level in (0.0, 1.0, -0.5, 1.5, float("nan")):
        with pytest.raises(ValueError, match="level must be between 0 and 1"):
            by_mixture.interval("normal_force", level)
    with pytest.raises(ValueError, match="between 0 and 1"):
        by_mixture.distribution("centre").quantile([0.5, 1.0])
    with pytest.raises(ValueError, match="one alpha"):
        skin.simulate().solve().interval("normal_force")


def test_results_of_skins(skin: tn.Skin, tmp_path: Path) -> None:
    result = tn.run(skin)
    answer = result.skin
    assert result["tikhonov"] is answer and result.succeeded and answer.verdict == "ok"
    assert result.truth.shape == (3, *skin.traction_shape) and result.readings.shape == (6, 5, 3)
    solution = skin.solve(result.readings)
    assert answer.tractions is not None and np.array_equal(answer.tractions, solution.tractions[0])
    assert answer.normal_force == (solution.normal_force[0], solution.normal_force_deviation[0])
    assert answer.torsion == (solution.torsion[0], solution.torsion_deviation[0])
    off = np.linalg.norm(answer.tractions - result.truth, axis=(1, 2)) / np.linalg.norm(result.truth[0])
    assert answer.relative_errors == pytest.approx(off)
    again = pickle.loads(pickle.dumps(result))
    assert str(again) == str(result) and again.to_json() == result.to_json()
    again.report(tmp_path / "again")
    assert "report.html" in {path.name for path in (tmp_path / "again").iterdir()}
    assert "<iframe" in result._repr_html_() and "<iframe" in solution._repr_html_()
    frames = moving(skin)
    assert not np.array_equal(tn.run(frames, frame=0).readings, tn.run(frames).readings)
    with pytest.raises(ValueError, match="frame"):
        tn.run(frames, frame=99)


def test_solutions_of_skins_are_pickled_and_tabled(skin: tn.Skin, tmp_path: Path) -> None:
    recording = moving(skin).simulate()
    solution = recording.solve()
    again = pickle.loads(pickle.dumps(solution))
    assert np.array_equal(again.wrench, solution.wrench, equal_nan=True) and again.to_json() == solution.to_json()
    again.report(tmp_path / "out")
    assert (tmp_path / "out/tractions-of-frames.csv").exists()
    data = solution.to_xarray()
    assert data["readings"].dims == ("t", "row", "column", "channel")
    assert data["tractions"].dims == ("t", "component", "y", "z")
    assert data["wrench"].sel(of="torsion").values == pytest.approx(solution.torsion)
    assert np.array_equal(tn.Recording.from_xarray(recording.to_xarray()).readings, recording.readings)
    assert np.array_equal(skin.solve(data["readings"]).tractions, solution.tractions)
    with pytest.raises(ValueError, match=r"dimensions \(row, column, channel\)"):
        skin.solve(data["readings"].transpose("t", "channel", "row", "column"))
    table = solution.to_dataframe()
    assert np.array_equal(table["torsion_deviation"], solution.torsion_deviation)
    assert tn.run(skin).to_xarray()["tractions"].dims == ("component", "y", "z")
    normal = skin.replace({"reconstruct.tangential": False}).simulate().solve()
    assert normal.tractions.shape[1] == 1 and normal.tangential.shape[1] == 0
    assert np.isnan(normal.tangential_force).all()
    assert np.isnan(normal.to_xarray()["tractions"].sel(component="tangential_z")).all()


@pytest.mark.parametrize("suffix", ["npz", "csv", "nc", "zarr", "parquet", "npy", "mcap"])
@pytest.mark.parametrize("path", [SPHERE, UNEVEN, PROJECT / "scenes/skins/fingertip.toml"], ids=lambda path: path.name)
def test_recordings_of_skins_in_every_container(path: Path, suffix: str, tmp_path: Path) -> None:
    scene = tn.Skin.load(path)
    recording = scene.simulate()
    file = tmp_path / f"skin.{suffix}"
    if suffix == "npy":
        if "units" in scene.to_dict():
            with pytest.raises(ValueError, match="says no units"):
                recording.save(file)
        np.save(file, scene.raw_numbers(recording.readings))
        assert np.allclose(scene.read(file).readings, recording.readings, rtol=1e-14)
        assert np.array_equal(tn.load(file, scene=scene, units="scene").readings, scene.read(file).readings)
        return
    recording.save(file)
    again = tn.load(file)
    assert np.array_equal(again.readings, recording.readings)
    assert recording.truth is not None and again.truth is not None and np.array_equal(again.truth, recording.truth)
    assert again.scene.text == scene.text and isinstance(again.scene, tn.Skin)
    if suffix == "mcap":
        again.solve().save(file)
        assert np.array_equal(tn.load(file).readings, recording.readings)
    elif suffix not in ("csv", "parquet"):
        solution = again.solve()
        solution.save(tmp_path / f"solution.{suffix}")
        kept = tn.Solution.load(tmp_path / f"solution.{suffix}")
        assert isinstance(kept, tn.SkinSolution)
        assert np.array_equal(kept.wrench, solution.wrench, equal_nan=True)
        assert np.array_equal(kept.touching, solution.touching) and kept.verdict.tolist() == solution.verdict.tolist()


def test_arrays_of_others_that_are_exchanged(skin: tn.Skin, tmp_path: Path) -> None:
    readings = moving(skin).simulate().readings
    np.save(tmp_path / "exchanged.npy", readings.transpose(0, 3, 1, 2))
    with pytest.raises(tn.InputError, match=r"readings.transpose\(0, 2, 3, 1\)"):
        tn.load(tmp_path / "exchanged.npy", scene=skin, units="scene")
    np.save(tmp_path / "kpa.npy", 1e-3 * readings)
    assert np.allclose(tn.load(tmp_path / "kpa.npy", scene=skin, units="kPa").readings, readings, rtol=1e-14)
    fingertip = tn.Skin.load(PROJECT / "scenes/skins/fingertip.toml")
    moved = fingertip.simulate().readings
    np.save(tmp_path / "um.npy", 1e6 * moved)
    assert np.allclose(tn.load(tmp_path / "um.npy", scene=fingertip, units="um").readings, moved, rtol=1e-14)
    with pytest.raises(tn.InputError, match="states the unit 'kPa' of displacement_x"):
        tn.load(tmp_path / "um.npy", scene=fingertip, units="kPa")


def test_what_skins_do_not_do_they_say(skin: tn.Skin) -> None:
    with pytest.raises(ValueError, match="tikhonov alone"):
        skin.solve(np.zeros((1, 90)), "dft")
    with pytest.raises(ValueError, match="compare_rules"):
        tn.run(skin, compare_rules=True)
    for options in ({"structure": "fft"}, {"allow_fft": True}):
        with pytest.raises(ValueError, match="an fft is for line arrays"):
            skin.plan(**options)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="no frame"):
        skin.solve(np.zeros((0, 90))).report("nowhere")
    with pytest.raises(tn.InputError, match="of a line array and of no skin"):
        tn.Skin.load(PROJECT / "scenes/fingertip.toml")
    assert {name for name in dir(tn.Scene) if not name.startswith("_")} <= set(dir(tn.Skin))


def test_errors_of_skins_have_their_place(skin: tn.Skin) -> None:
    with pytest.raises(tn.InputError) as caught:
        skin.replace({"sensor.rows": 0, "contact.0.raduis": 1.0})
    lines = [(one.line, one.column) for one in caught.value.diagnostics]
    assert len(lines) == 2 and all(line > 0 and column > 0 for line, column in lines)
    assert "raduis" in str(caught.value) and "rows" in str(caught.value)
    with pytest.raises(tn.InputError, match="alpha"):
        skin.replace({"reconstruct.alpha": -1.0})
    with pytest.raises(ValueError, match="alpha"):
        skin.solver(alpha=-1.0)


def test_pictures_of_skins(skin: tn.Skin) -> None:
    import matplotlib

    matplotlib.use("agg")
    recording = moving(skin).simulate()
    solution = recording.solve()
    ax = tn.plot.tractions(solution)
    assert ax.get_xlabel() == "y [mm]" and ax.yaxis_inverted() and len(ax.collections) >= 3
    assert tn.plot.result(tn.run(skin)).get_ylabel() == "z [mm]"
    assert tn.plot.readings(recording).get_ylabel() == "z [mm]"
    assert tn.plot.over_time(solution).get_ylabel() == "force [N]"
    of_mixture = skin.replace({"reconstruct.alpha": None, "reconstruct.answer": "mixture"}).solve(recording)
    band = tn.plot.over_time(of_mixture).collections[0].get_datalim(matplotlib.pyplot.gca().transData)
    force = of_mixture.interval("normal_force")
    assert (band.y0, band.y1) == pytest.approx((force.min(), force.max()))
    line = tn.Scene.load(PROJECT / "scenes/fingertip.toml")
    with pytest.raises(ValueError, match="is of skins"):
        tn.plot.pressure_map(line, np.zeros((1, 3, 3)))
    matplotlib.pyplot.close("all")


def test_a_frame_over_the_edge_takes_no_other_frame_its_interval() -> None:
    def pressed(place: float) -> tn.Skin:
        return tn.Skin(
            sensor=tn.Sensor(rows=6, columns=6, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
            material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
            contacts=[tn.Sphere(force=0.3, radius=3e-3, place=[place, 0.0])],
            noise=tn.Noise(rms=50.0),
        )

    inside = pressed(0.0)
    over, within = (pressed(place).simulate().readings for place in (5.5e-3, 0.0))
    solution = inside.solve(np.concatenate([over, within]))
    assert solution.verdict.tolist() == ["cut_off", "ok"]
    assert np.isfinite(solution.normal_force_deviation).all()
    for what in ("normal_force", "centre"):
        both = solution.interval(what)
        assert np.isnan(both[0]).all()
        assert np.array_equal(both[1], inside.solve(within).interval(what)[0])
    with pytest.raises(ValueError, match="one alpha's"):
        inside.solve(over).interval("normal_force")

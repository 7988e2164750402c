"""Recordings on disk: which container a file is, by what it begins with; and which it becomes, by its name."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, overload

from ._optional import part
from ._refusal import refused

if TYPE_CHECKING:
    from numpy.typing import DTypeLike

    from ._geometry import Geometry
    from ._judge import Units
    from ._layout import Layout
    from ._recording import Recording, Solution
    from ._scene import Scene
    from .errors import InputError
    from .sensors import SensorRecording

_SUFFIXES = (".npy", ".npz", ".csv", ".nc", ".h5", ".hdf5", ".zarr", ".parquet", ".mcap")
_STRANGERS = {
    b"\x80": "is a Python pickle, which can run anything when it is loaded",
    b"\x1f\x8b": "is compressed by gzip: gunzip it",
    b"BZh": "is compressed by bzip2: bunzip2 it",
    b"\xfd7zXZ": "is compressed by xz: xz -d it",
    b"(\xb5/\xfd": "is compressed by zstd: zstd -d it",
    b"MATLAB ": "is a MATLAB file: scipy.io.loadmat gives its arrays, which numpy.savez saves",
}


@overload
def load(
    path: str | PathLike[str],
    *,
    scene: Scene | None = None,
    units: Units | None = None,
    name: str | None = None,
    missing: bool = True,
) -> Recording: ...
@overload
def load(
    path: str | PathLike[str],
    *,
    sensor: str | None = None,
    model: str | None = None,
    geometry: Geometry | str | PathLike[str] | None = None,
    thickness: float | None = None,
    youngs_modulus: float | None = None,
    poisson_ratio: float | None = None,
    base: str = "bonded",
    depth: float | None = None,
    reference: Sequence[float] | None = None,
    noise: float | None = None,
    units: str | Mapping[str, str] | None = None,
    name: str | None = None,
    reads: str | None = None,
    frame: str | None = None,
    gain: float | Sequence[float] | None = None,
    pitch: float | Sequence[float] | None = None,
) -> SensorRecording: ...
def load(
    path: str | PathLike[str],
    *,
    scene: Scene | None = None,
    units: Units | None = None,
    name: str | None = None,
    missing: bool = True,
    **sensor: Any,
) -> Recording | SensorRecording:
    """A recording from .npy, .npz, CSV, netCDF-4 or any HDF5, Zarr, Parquet, MCAP or a ROS bag: known by content, not by
    name; or a `sensors.SensorRecording` of a sensor's own files, where any of the names under **sensor is given.

    scene: of a file that says none, or in place of the one inside.
    units: of a file that says none: "kPa", {"stress_x": "kPa", "strain_x": "1"}, or "scene": as the scene says of its
    files of readings, with its calibration; None: "scene", where that has [units] or [calibration].
    name: which of several recordings, arrays, datasets, columns, topics or sensors.
    missing: readings that are not finite are missing values, of which a note tells; False: they are refused.
    sensor: `sensor` is one of `tn.sensors.names()`; None or left out: the only one whose file this looks like. Of the pad:
    `thickness` [m], `youngs_modulus` [Pa] (not needed where forces or stresses are read), `poisson_ratio`, `base`, `depth` of
    the taxels [m], `reference` (the direction that e_y follows; None: y, or another where y is too near a normal), `noise` (one standard deviation of a reading, in SI).
    Of the sensor: `geometry` (a `Geometry` or its CSV), and what `tn.sensors.Given` has: `model`, `reads`, `frame`, `gain`, `pitch`.
    Raises InputError, which says what is wrong and what to do; warns with CutOffWarning where only a part is whole.
    """
    from ._judge import as_it_says, judged

    where = fspath(path)
    if sensor:
        from . import sensors

        if scene is not None or not missing:
            raise TypeError("scene= and missing= are of recordings, and a sensor's file makes its own scene")
        return sensors.load(where, units=units, name=name, **sensor)
    if os.path.isdir(where) and scene is None and _sensors_of(where):
        raise no_scene(where)
    if _is_log(where):
        recording: Recording = part("logs").read(where, topic=name, scene=scene, units=units, missing=missing)
        return recording
    with as_it_says(where):
        layout = _read(where, name)
    if layout is None:
        return _stranger_csv(where, scene, units, missing)
    return judged(layout, where, scene, units, missing)


def load_solution(path: str | PathLike[str], name: str | None) -> Solution:
    from ._judge import as_it_says, judged
    from ._layout import solution_in

    where = fspath(path)
    with as_it_says(where):
        layout = None if _is_log(where) else _read(where, name)
        if layout is None:
            raise refused(where, "holds readings and no solution", "tactile_net.load(path).solve()")
        return solution_in(layout, judged(layout, where, None, None, True), where)


def save(
    what: Recording | Solution, path: str | PathLike[str], name: str | None, dtype: DTypeLike, append: bool
) -> None:
    from . import _containers as plain
    from . import _exchange
    from ._judge import rising
    from ._layout import layout_of

    where = fspath(path)
    suffix = os.path.splitext(where)[1].lower()
    if suffix not in _SUFFIXES:
        raise ValueError(
            f"{where}: a recording is saved as {', '.join(_SUFFIXES)}, not as {suffix or 'a name without'}"
        )
    grouped = suffix in _exchange.HDF5 + _exchange.ZARR
    if append and not grouped:
        raise ValueError(
            f"{where}: only netCDF-4 and Zarr hold several recordings: append=True needs .nc, .h5 or .zarr"
        )
    if name is not None and not name.isidentifier():
        raise ValueError(f"{where}: name must be letters, digits and _ (got {name!r})")
    if suffix == ".mcap":
        part("logs").write(where, what, topic=f"/{name or 'pad'}", dtype=dtype)
        return
    if what.t is not None:
        rising(where, what.t)
    if grouped:
        _exchange.write(where, _exchange.dataset_of(what._layout(dtype), what.scene), name, append)
        return
    layout = layout_of(what, dtype)
    if suffix in (".csv", ".parquet"):
        refuse_solution(what, where, suffix)
    if suffix == ".npy":
        refuse_as_npy(what, where)
    writers: dict[str, Callable[[str], None]] = {
        ".npy": lambda to: plain.write_npy(to, layout),
        ".npz": lambda to: plain.write_npz(to, layout),
        ".csv": lambda to: plain.write_csv(to, layout, what.scene),
        ".parquet": lambda to: _exchange.write_parquet(to, layout, what.scene),
    }
    with whole(where) as to:
        writers[suffix](to)


def refuse_solution(what: Recording | Solution, where: str, suffix: str) -> None:
    from ._recording import Recording

    if not isinstance(what, Recording):
        raise ValueError(
            f"{where}: a {suffix} holds readings and no solution: .npz, .nc and .zarr hold both; "
            "solution.to_dataframe() is a table of its forces"
        )


def refuse_as_npy(what: Recording | Solution, where: str) -> None:
    """A .npy is an array and nothing else: who reads it takes its numbers as the scene's files of readings."""
    from ._containers import takes_si

    refuse_solution(what, where, ".npy")
    if not takes_si(what.scene):
        raise ValueError(
            f"{where}: a .npy says no units, and files of readings of this scene have its own: save .npz, or "
            "numpy.save(path, scene.raw_numbers(recording.readings))"
        )


@contextlib.contextmanager
def whole(path: str, append: bool = False) -> Iterator[str]:
    """A file or folder beside it to write to, which takes its place when all is written."""
    import shutil

    beside, before = (f"{path}.{os.getpid()}.{suffix}" for suffix in ("part", "before"))
    try:
        if append and os.path.exists(path):
            (shutil.copytree if os.path.isdir(path) else shutil.copyfile)(path, beside)
        yield beside
        if os.path.isdir(path) and os.path.isdir(beside):  # no folder takes the place of a full one
            os.rename(path, before)
        os.replace(beside, path)
    finally:
        if os.path.exists(before) and not os.path.exists(path):
            os.rename(before, path)
        for left in (beside, before):
            shutil.rmtree(left, ignore_errors=True)
            with contextlib.suppress(OSError):
                os.unlink(left)


def _start(where: str) -> bytes:
    with open(where, "rb") as file:
        start = file.read(512)
    if not start:
        raise refused(where, "is empty")
    return start


def _is_log(where: str) -> bool:
    """A folder that is no Zarr is one of ROS 2's bags."""
    from ._exchange import is_zarr

    marks = (b"\x89MCAP0\r\n", b"#ROSBAG V", b"SQLite format 3")
    return not is_zarr(where) if os.path.isdir(where) else _start(where).startswith(marks)


def _read(where: str, name: str | None) -> Layout | None:
    """None: a CSV that is not of this package."""
    from . import _containers as plain
    from . import _exchange

    if os.path.isdir(where):
        return _exchange.read(where, name)
    readers: dict[bytes, Callable[[str, str | None], Layout]] = {
        b"\x93NUMPY": plain.read_npy,
        b"PK": plain.read_npz,
        b"\x89HDF\r\n\x1a\n": _exchange.read,
        b"PAR1": _exchange.read_parquet,
    }
    start = _start(where)
    for mark, read in readers.items():
        if start.startswith(mark):
            return read(where, name)
    for mark, words in _STRANGERS.items():
        if start.startswith(mark):
            raise refused(where, words)
    return plain.read_own_csv(where) if start.startswith(plain.CSV_MARK.encode()) else None


def _sensors_of(where: str) -> dict[str, float]:
    from . import sensors

    return sensors.sniffed(where)


def no_scene(where: str) -> InputError:
    """The refusal of a file without a scene, which names the sensors whose file it looks like."""
    found = _sensors_of(where)
    like = "".join(f', or sensor="{name}", whose file it looks like' for name in found)
    return refused(where, "says no scene that its readings are of", f"give scene={like}")


def _stranger_csv(where: str, scene: Scene | None, units: Units | None, missing: bool) -> Recording:
    """By the library's reader, which knows columns by many names."""
    from ._judge import absent, in_si, rising
    from ._recording import Recording

    if scene is None:
        raise no_scene(where)
    notes: list[str] = []
    if units in (None, "scene") and {"units", "calibration"} & scene.to_dict().keys():
        as_written = scene.read(where, missing=missing)
        values = as_written.readings
    else:
        as_written = scene.replace({"units": {}, "calibration": None}).read(where, missing=missing)
        # Judges units=; the numbers themselves are calibrated by the reader.
        values, notes = in_si(where, as_written.readings, scene, units, None)
    times = [] if as_written.t is None else rising(where, as_written.t)
    notes = [*as_written.notes, *notes, *times, *absent(where, values, scene, missing)]
    return Recording(scene, values, as_written.t, None, tuple(dict.fromkeys(notes)))

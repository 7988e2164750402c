"""Data sets to learn from: a study's simulated frames, readings beside the tractions that pressed, as Parquet or Zarr.

    study = tn.Study(scene, {"contact.0.force": {"from": 0.1, "to": 2.0}}, draw={"kind": "sobol", "count": 1000})
    data = tn.datasets.generate(study, "frames.parquet")
    data.readings, data.tractions, data["contact.0.force"]      # a row for each frame

It is a sweep that keeps arrays: the same points in the same order with the same seeds, on this machine or by Dask, and what was
stopped goes on where it was. docs/sweeps.md has it all.
"""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from hashlib import sha256
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._files import whole
from ._layout import Layout, attributes_of, scene_in
from ._optional import optional
from ._points import StudyCopy, StudyHere, computed
from ._progress import Progress, listening
from ._refusal import counted, refused
from ._scene import Scene
from ._sweep import Study, saved

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Dataset", "generate", "load"]

_KINDS = ("readings", "tractions")


class Dataset:
    """Frames of all points of a study, in its order. Made by `generate` and `load`."""

    scene: Scene
    """The study's own: what every point begins with."""
    readings: NDArray[np.float32]
    """(F, C, N), of skins (F, rows, columns, C), of uneven arrays (F, R)."""
    tractions: NDArray[np.float32] | None
    """(F, 2, M), of skins (F, 3, rows, columns): what pressed; None where they were not kept."""
    point: NDArray[np.int64]
    """(F,): which point of the study each frame is of; a row of the parameters."""
    parameters: dict[str, NDArray[Any]]
    """(P,) each: the axes by their keys, `seed`, and `failure`, why a point has no frame."""
    sha256: str
    """Of all points: the same whoever computed what, in whichever format, on machines of one set of instructions."""

    def __init__(self, held: _Held, where: str) -> None:
        self.scene = scene_in(Layout({}, held.attributes), where)
        self.axes = tuple(json.loads(held.attributes["axes"]))
        self.point = np.repeat(np.arange(len(held.frames)), held.frames)
        self.parameters = held.parameters
        self.readings = _framed(self.scene, held.readings)
        self.tractions = None
        if held.tractions is not None:
            self.tractions = held.tractions.reshape(len(self.point), -1, *self.scene.traction_shape)
        self.sha256 = _digest(held)

    def __getitem__(self, key: str) -> NDArray[Any]:
        """(F,): a parameter, of each frame."""
        return np.asarray(self.parameters[key][self.point])

    def __len__(self) -> int:
        return len(self.readings)

    def __repr__(self) -> str:
        points = len(self.parameters["seed"])
        return f"<Dataset of {len(self)} frames of {points} points, axes {', '.join(self.axes)}>"


def generate(
    study: Study | str | PathLike[str],
    store: str | PathLike[str],
    *,
    keep: Sequence[str] = _KINDS,
    jobs: int | None = None,
    chunk: int = 256,
    allow_outside: bool = False,
    progress: Progress = False,
    client: Any = None,
) -> Dataset:
    """Simulates every frame of every point of a study into `store`, NAME.parquet or NAME.zarr.

    The store is a folder, which pyarrow and pandas, or zarr and xarray, read too: float32 readings and tractions beside the
    points' parameters; a Zarr store has as many frames at each point, NaN at those that failed. Chunks of so many points are
    written whole, and those that are there are not computed again, however the last call ended.
    keep: "readings" and "tractions", or the first alone. jobs: threads; None: one for each processor. client: a
    dask.distributed.Client, whose workers compute in place of this machine.

    Raises InputError for a study that is none, or whose points have readings of different shapes; OSError where another
    process writes into the store, or nothing can be written; RuntimeError where workers died of points.
    """
    if "readings" not in keep or not set(keep) <= set(_KINDS):
        raise ValueError(f'keep must be ["readings", "tractions"] or ["readings"] (got {list(keep)})')
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs must be at least 1 (got {jobs})")
    if chunk < 1:
        raise ValueError(f"chunk must be at least 1 (got {chunk})")
    place = Path(store)
    form = _form_of(place)
    with saved(study) as path, listening(progress) as heard, ExitStack() as until_the_end:
        points = _core.StudyPoints(path, allow_outside)
        until_the_end.enter_context(_locked(place))
        scene = Scene.parse(points.scene_text, file=points.scene_file)
        attributes = attributes_of(scene, ()) | {
            "study": points.hash,
            "title": points.title,
            "points": str(points.points),
            "chunk": str(chunk),
            "axes": json.dumps(points.axes),
            "keep": " ".join(kind for kind in _KINDS if kind in keep),
            "tactile_net": _core.version,
            "instructions": _core.instructions,
        }
        writer = form(place, attributes, points.values, scene)
        chunks = [range(first, min(first + chunk, points.points)) for first in range(0, points.points, chunk)]
        missing = [index for c, indices in enumerate(chunks) if not writer.has(c) for index in indices]
        begun: dict[int, dict[int, _Point]] = {}
        come: set[int] = set()
        compute = partial(_frames, tractions="tractions" in keep)
        there = StudyHere(points) if client is None else StudyCopy.of(path, points, allow_outside)
        for part, found in computed(compute, there, missing, client, jobs):
            for index, point in zip(part, found, strict=True):
                begun.setdefault(index // chunk, {})[index] = point
            for c in {index // chunk for index in part}:
                if len(begun[c]) == len(chunks[c]):
                    of_chunk = begun.pop(c)
                    writer.write(c * chunk, [of_chunk[index] for index in chunks[c]])
            come.update(part)
            if heard is not None:
                heard(f"{len(come)} of {counted(len(missing), 'point')}")
        if len(come) < len(missing):
            dead = sorted(set(missing) - come)
            raise RuntimeError(
                f"workers died of {counted(len(dead), 'point')} that they were given: {', '.join(map(str, dead[:20]))}"
                f"{' ...' if len(dead) > 20 else ''}; generate again with the same study to try what is missing once more"
            )
    return load(place)


def load(store: str | PathLike[str]) -> Dataset:
    """What `generate` has written. Raises InputError where it is no data set, or points are missing."""
    held = _form_of(Path(store)).read(Path(store))
    if len(held.readings) == 0:
        raise refused(fspath(store), f"has no frame: {held.parameters['failure'][0]}")
    return Dataset(held, fspath(store))


@dataclass
class _Point:
    """What becomes of one point of a study."""

    values: list[str]
    seed: int
    readings: NDArray[np.float32]
    """(frames, R)"""
    tractions: NDArray[np.float32] | None
    """(frames, T)"""
    failure: str


@dataclass
class _Held:
    """What a store holds, all points of it."""

    attributes: dict[str, str]
    parameters: dict[str, NDArray[Any]]
    frames: NDArray[np.int64]
    """(P,): how many each point has."""
    readings: NDArray[np.float32]
    """(F, R)"""
    tractions: NDArray[np.float32] | None
    """(F, T)"""


def _framed(scene: Scene, rows: NDArray[np.float32]) -> NDArray[np.float32]:
    """(F, R) in the shape of the scene's readings."""
    frames: Any = scene
    return np.asarray(frames._framed(rows))


def _frames(study: StudyHere | StudyCopy, indices: list[int], *, tractions: bool) -> list[_Point]:
    points = study.points()
    all_of = []
    for index in indices:
        values, seed, readings, truth, failure = points.simulate(index)
        with np.errstate(over="ignore"):
            kept = truth.astype(np.float32) if tractions else None
            all_of.append(_Point(values, seed, readings.astype(np.float32), kept, failure))
    return all_of


def _digest(held: _Held) -> str:
    digests = []
    ends = np.cumsum(held.frames)
    seeds, failures = held.parameters["seed"], held.parameters["failure"]
    for index, (end, frames) in enumerate(zip(ends, held.frames, strict=True)):
        digest = sha256(f"{index} {seeds[index]} {failures[index]}".encode())
        for numbers in (held.readings, held.tractions):
            if numbers is not None:
                digest.update(np.ascontiguousarray(numbers[end - frames : end], dtype="<f4").tobytes())
        digests.append(digest.hexdigest())
    return sha256("\n".join(digests).encode()).hexdigest()


class _Store:
    """What both formats have: one study, in chunks of points, of one shape."""

    def __init__(self, place: Path, attributes: dict[str, str], values: list[list[str]], scene: Scene) -> None:
        self.place = place
        self.attributes = attributes
        self.axes: list[str] = json.loads(attributes["axes"])
        self.numeric = [_is_numeric(of_axis) for of_axis in values]
        self.scene = scene
        self.widths: list[int] | None = None

    def check(self, told: dict[str, str]) -> None:
        if told != self.attributes:
            raise refused(
                fspath(self.place),
                "is of another study, version or set of instructions, keeps other things, or has other chunks",
                "a study that was changed begins another store",
            )

    def judge(self, first: int, points: list[_Point]) -> None:
        """Raises InputError where a point has another shape than the study's scene, or than those before."""
        for index, point in enumerate(points, first):
            if len(point.readings) == 0:
                continue
            widths = [kept.shape[1] for kept in (point.readings, point.tractions) if kept is not None]
            size = int(np.prod(self.scene.traction_shape))
            if widths[0] != len(self.scene.reading_names):  # an axis has set the taxels for all points
                raise refused(
                    fspath(self.place),
                    f"point {index} has {widths[0]} readings, and the study's scene {len(self.scene.reading_names)}",
                    "a data set has one shape: leave axes out that change taxels",
                )
            if (self.widths or widths) != widths or (len(widths) > 1 and widths[1] % size != 0):
                raise refused(
                    fspath(self.place),
                    f"point {index} has other tractions than those before it, or than the study's scene: {widths[-1]}",
                    "a data set has one shape: set reconstruct.spacing and reconstruct.margin, where cells would follow the depth",
                )
            self.widths = widths

    def columns(self, points: list[_Point]) -> dict[str, NDArray[Any]]:
        """The parameters, (points,) each."""
        columns: dict[str, NDArray[Any]] = {}
        for i, key in enumerate(self.axes):
            of_axis = [point.values[i] for point in points]
            columns[key] = np.array([float(value) for value in of_axis]) if self.numeric[i] else np.array(of_axis)
        columns["seed"] = np.array([point.seed for point in points], dtype=np.int64)
        columns["failure"] = np.array([point.failure for point in points])
        return columns


class _Parquet(_Store):
    """A file for each chunk, a row for each frame; a point that failed has one without numbers."""

    def __init__(self, place: Path, attributes: dict[str, str], values: list[list[str]], scene: Scene) -> None:
        super().__init__(place, attributes, values, scene)
        self.arrow = optional("pyarrow", "datasets")
        self.files = optional("pyarrow.parquet", "datasets")
        for left in place.glob("*.part"):  # of a call that was killed
            left.unlink()
        for path in sorted(place.glob("*.parquet")):
            schema = self.files.read_schema(path)
            self.check(_told(schema.metadata, place))

    def _path(self, chunk: int) -> Path:
        return self.place / f"chunk-{chunk:06}.parquet"

    def has(self, chunk: int) -> bool:
        return self._path(chunk).exists()

    def write(self, first: int, points: list[_Point]) -> None:
        self.judge(first, points)
        frames = np.array([len(point.readings) for point in points])
        rows = np.maximum(frames, 1)
        columns: dict[str, Any] = {
            "point": np.repeat(np.arange(first, first + len(points)), rows),
            "frame": np.concatenate([np.arange(count) for count in rows]),
        }
        columns |= {key: np.repeat(values, rows) for key, values in self.columns(points).items()}
        for kind in self.attributes["keep"].split():
            numbers = [getattr(point, kind) for point in points]
            sizes = np.concatenate([np.full(len(one), one.shape[1]) if len(one) > 0 else np.zeros(1, int) for one in numbers])
            flat = np.concatenate([one.ravel() for one in numbers])
            columns[kind] = self.arrow.ListArray.from_arrays(
                self.arrow.array(np.concatenate(([0], np.cumsum(sizes))), self.arrow.int32()), self.arrow.array(flat)
            )
        table = self.arrow.table(columns).replace_schema_metadata({"tactile_net": json.dumps(self.attributes)})
        with whole(fspath(self._path(first // int(self.attributes["chunk"])))) as to:
            self.files.write_table(table, to)

    @staticmethod
    def read(place: Path) -> _Held:
        files = optional("pyarrow.parquet", "datasets")
        tables = [files.read_table(path) for path in sorted(place.glob("*.parquet"))]
        if not tables:
            raise refused(fspath(place), "holds no data set", "tactile_net.datasets.generate makes them")
        attributes = _told(tables[0].schema.metadata, place)
        for table in tables:
            if _told(table.schema.metadata, place) != attributes:
                raise refused(fspath(place), "holds chunks of different studies or versions", "begin another store")

        def column(name: str) -> NDArray[Any]:
            return np.concatenate([table[name].to_numpy() for table in tables])

        first = column("frame") == 0
        there = column("point")[first]
        _check_all(there, int(attributes["points"]), place)
        sizes = np.concatenate([np.diff(part.offsets.to_numpy()) for table in tables for part in table["readings"].chunks])
        frames = np.bincount(column("point")[sizes > 0], minlength=len(there))

        def numbers(kind: str) -> NDArray[np.float32]:
            lists = [part for table in tables for part in table[kind].chunks]
            flat: NDArray[np.float32] = np.concatenate([part.flatten().to_numpy() for part in lists])
            count = int(frames.sum())
            return flat.reshape(count, flat.size // max(count, 1))

        parameters = {key: _plain(column(key)[first]) for key in (*json.loads(attributes["axes"]), "seed", "failure")}
        tractions = numbers("tractions") if "tractions" in attributes["keep"].split() else None
        return _Held(attributes, parameters, frames, numbers("readings"), tractions)


class _Zarr(_Store):
    """An array for each kind and parameter, of which a chunk is one of the study's."""

    def __init__(self, place: Path, attributes: dict[str, str], values: list[list[str]], scene: Scene) -> None:
        super().__init__(place, attributes, values, scene)
        if any(path.name != "zarr.json" for path in place.iterdir()) and not (place / "zarr.json").exists():
            raise refused(fspath(place), "holds files that are no data set", "name another folder")
        self.group = optional("zarr", "datasets").open_group(fspath(place), mode="a", zarr_format=3)
        if self.group.attrs:
            self.check(dict(self.group.attrs))
        else:
            self.group.attrs.update(attributes)
        self.count, self.chunk = int(attributes["points"]), int(attributes["chunk"])
        if "done" not in self.group:
            for i, key in enumerate(self.axes):
                self._array(key, float if self.numeric[i] else str)
            self._array("seed", np.int64)
            self._array("failure", str)
            chunks = -(-self.count // self.chunk)
            self.group.create_array("done", shape=(chunks,), chunks=(1,), dtype=bool, dimension_names=("chunk",))

    def _array(self, name: str, dtype: Any, shape: tuple[int, ...] = (), names: tuple[str, ...] = ()) -> None:
        if name in self.group:  # of a call that was killed
            return
        fill = {"fill_value": np.nan} if shape else {}
        self.group.create_array(
            name, shape=(self.count, *shape), chunks=(self.chunk, *shape), dtype=dtype, dimension_names=("point", *names), **fill
        )

    def has(self, chunk: int) -> bool:
        return bool(self.group["done"][chunk])

    def write(self, first: int, points: list[_Point]) -> None:
        self.judge(first, points)
        here = slice(first, first + len(points))
        for key, values in self.columns(points).items():
            self.group[key][here] = values
        for kind in self.attributes["keep"].split() if any(len(point.readings) > 0 for point in points) else ():
            numbers = [getattr(point, kind) for point in points]
            shape = next(one.shape for one in numbers if len(one) > 0)
            framed = partial(_framed, self.scene) if kind == "readings" else self._pressed
            inner = framed(np.zeros(shape, dtype=np.float32)).shape
            names = tuple(f"{kind}_{i}" for i in range(len(inner) - 1))
            self._array(kind, np.float32, inner, ("frame", *names))
            if self.group[kind].shape[1:] != inner or any(one.shape != shape for one in numbers if len(one) > 0):
                raise refused(
                    fspath(self.place),
                    "points have different numbers of frames, and a Zarr store as many at each",
                    "write NAME.parquet, or leave time out of the axes",
                )
            self.group[kind][here] = np.stack(
                [framed(one) if len(one) > 0 else np.full(inner, np.nan, np.float32) for one in numbers]
            )
        self.group["done"][first // self.chunk] = True

    def _pressed(self, rows: NDArray[np.float32]) -> NDArray[np.float32]:
        return rows.reshape(len(rows), -1, *self.scene.traction_shape)

    @staticmethod
    def read(place: Path) -> _Held:
        if not (place / "zarr.json").exists():
            raise refused(fspath(place), "holds no data set", "tactile_net.datasets.generate makes them")
        group = optional("zarr", "datasets").open_group(fspath(place), mode="r")
        attributes = dict(group.attrs)
        count, chunk = int(attributes.get("points", 0)), int(attributes.get("chunk", 1))
        done = np.asarray(group["done"][:]) if "done" in group else np.zeros(0, dtype=bool)
        _check_all(np.flatnonzero(np.repeat(done, chunk)[:count]), count, place)
        parameters = {key: _plain(group[key][:]) for key in (*json.loads(attributes["axes"]), "seed", "failure")}
        scene = scene_in(Layout({}, attributes), fspath(place))
        there = parameters["failure"] == ""
        frames = np.zeros(count, dtype=np.int64)

        def numbers(kind: str) -> NDArray[np.float32]:
            if kind not in group:
                return np.zeros((0, 0), dtype=np.float32)
            kept: NDArray[np.float32] = np.asarray(group[kind][:])[there]
            frames[there] = kept.shape[1]
            flat = kept.reshape(int(frames.sum()), *kept.shape[2:])
            return scene._ordered(flat) if kind == "readings" else flat.reshape(len(flat), -1)

        tractions = numbers("tractions") if "tractions" in attributes["keep"].split() else None
        return _Held(attributes, parameters, frames, numbers("readings"), tractions)


def _form_of(place: Path) -> Any:
    forms = {".parquet": _Parquet, ".zarr": _Zarr}
    if place.suffix not in forms:
        raise ValueError(f"{place}: a data set is NAME.parquet or NAME.zarr")
    return forms[place.suffix]


def _told(metadata: dict[bytes, bytes] | None, place: Path) -> dict[str, str]:
    try:
        told: dict[str, str] = json.loads((metadata or {})[b"tactile_net"])
        return told
    except KeyError:
        raise refused(fspath(place), "holds files that are no data set", "name another folder") from None


def _check_all(there: NDArray[np.int64], count: int, place: Path) -> None:
    missing = np.setdiff1d(np.arange(count), there)
    if missing.size > 0 or count == 0:
        raise refused(
            fspath(place),
            f"lacks {missing.size} of {count} points, {missing[:1].tolist()} first",
            "generate again with the same study: that computes what is missing",
        )


def _is_numeric(values: list[str]) -> bool:
    try:
        return bool([float(value) for value in values])
    except ValueError:
        return False


def _plain(values: NDArray[Any]) -> NDArray[Any]:
    """Text as NumPy's own, whatever a library makes of it."""
    return values if values.dtype.kind in "fiu" else np.array([str(value) for value in values])


@contextmanager
def _locked(place: Path) -> Iterator[None]:
    """Makes the folder; the lock on it ends with the process, however that ends."""
    place.mkdir(parents=True, exist_ok=True)
    folder = os.open(place, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BlockingIOError(f"{place}: another process writes into this store") from None
        yield
    finally:
        os.close(folder)

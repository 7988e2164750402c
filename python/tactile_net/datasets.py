"""Data sets to learn from: a study's simulated frames, readings beside the tractions that pressed.

    study = tn.Study(scene, {"contact.0.force": {"from": 0.1, "to": 2.0}}, draw={"kind": "sobol", "count": 1000})
    data = tn.datasets.generate(study, "frames")
    data.readings, data.tractions, data["contact.0.force"]      # a row for each frame

It is a sweep that keeps arrays: the same points in the same order with the same seeds, computed in shards, and what was
stopped goes on where it was. docs/sweeps.md has it all.
"""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from hashlib import sha256
from itertools import islice
from os import PathLike, fspath
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeAlias

import numpy as np

from . import _core
from ._files import whole
from ._layout import Layout, attributes_of, scene_in
from ._progress import Progress, listening
from ._refusal import counted, refused
from ._scene import Scene
from ._sweep import Study

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Dataset", "generate", "load"]

Point: TypeAlias = "tuple[list[str], int, NDArray[np.float64], NDArray[np.float64], str]"
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
    """Of all points: the same in however many shards they were computed, on machines of one set of instructions."""

    def __init__(self, scene: Scene, arrays: dict[str, NDArray[Any]], axes: Sequence[str]) -> None:
        self.scene = scene
        self.axes = tuple(axes)
        self.readings = arrays["readings"]
        self.tractions = arrays.get("truth")
        self.point = arrays["point"]
        self.parameters = {key: arrays[f"parameter:{key}"] for key in (*axes, "seed", "failure")}
        self.sha256 = sha256("\n".join(arrays["digest"].tolist()).encode()).hexdigest()

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
    folder: str | PathLike[str],
    *,
    keep: Sequence[str] = _KINDS,
    jobs: int | None = None,
    shard: tuple[int, int] = (1, 1),
    allow_outside: bool = False,
    progress: Progress = False,
) -> Dataset | None:
    """Simulates every frame of every point of a study, on `jobs` threads (None: all processors), into `folder`.

    Each shard is one file, shard-K-of-N.npz, of float32 readings and tractions with a table of the points' parameters;
    `tn.load` reads one as a recording. Points that are done are not computed again, however the last call ended.
    keep: "readings" and "tractions", or the first alone. shard: (3, 8) is the third of eight, as of `tn.sweep`; the
    answer is None then, and `load` puts them together.

    Raises InputError for a study that is none, or whose points have readings of different shapes; OSError where another
    process is at work on the shard, or nothing can be written.
    """
    number, count = shard
    if not 1 <= number <= count:
        raise ValueError(f"shard must be (K, N) with K from 1 to N (got {tuple(shard)})")
    if "readings" not in keep or not set(keep) <= set(_KINDS):
        raise ValueError(f'keep must be ["readings", "tractions"] or ["readings"] (got {list(keep)})')
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs must be at least 1 (got {jobs})")
    place = Path(folder)
    place.mkdir(parents=True, exist_ok=True)
    path = study.save(place) if isinstance(study, Study) else fspath(study)
    points = _core.StudyPoints(path, allow_outside)
    with listening(progress) as heard:
        _Shard(place, points, number, count, "tractions" in keep).fill(jobs or len(os.sched_getaffinity(0)), heard)
    return load(place) if count == 1 else None


def load(*folders: str | PathLike[str]) -> Dataset:
    """All shards of a data set put together, in the study's order.

    Raises InputError where there is none, points are missing, or shards are of different studies.
    """
    where = ", ".join(fspath(folder) for folder in folders)
    files = sorted(path for folder in folders for path in Path(folder).glob("shard-*-of-*.npz"))
    if not files:
        raise refused(where, "holds no shard of a data set", "tactile_net.datasets.generate makes them")
    held: list[dict[str, NDArray[Any]]] = []
    told: list[dict[str, str]] = []
    for file in files:
        with np.load(file, allow_pickle=False) as arrays:
            held.append({name: arrays[name] for name in arrays.files})
        told.append(json.loads(str(held[-1].pop("attributes"))))
        if _common(told[-1]) != _common(told[0]):
            raise refused(fspath(file), f"is of another study, or another version, than {files[0]}")
    index = np.concatenate([one["index"] for one in held])
    missing = np.setdiff1d(np.arange(int(told[0]["points"])), index)
    if missing.size > 0:
        raise refused(
            where,
            f"lacks {missing.size} of {told[0]['points']} points, {missing[0]} first",
            "generate again with the same study and shard: that computes what is missing",
        )
    _, first = np.unique(index, return_index=True)  # a point that two shards have stands once
    frames = np.concatenate([one["point"] for one in held])
    owner = np.concatenate([np.full(len(one["point"]), i) for i, one in enumerate(held)])
    of_point = np.concatenate([np.full(len(one["index"]), i) for i, one in enumerate(held)])[first]
    taken = np.flatnonzero(of_point[frames] == owner)
    taken = taken[np.argsort(frames[taken], kind="stable")]
    arrays = {
        name: np.concatenate([one[name] for one in held])[first]
        for name in held[0]
        if name == "digest" or name.startswith("parameter:")
    }
    arrays |= {
        name: np.concatenate([one[name] for one in held])[taken] for name in ("readings", "truth") if name in held[0]
    }
    scene = scene_in(Layout({}, told[0]), fspath(files[0]))
    return Dataset(scene, arrays | {"point": frames[taken]}, json.loads(told[0]["axes"]))


def _common(told: dict[str, str]) -> dict[str, str]:
    return {key: value for key, value in told.items() if key not in ("shard", "notes")}


class _Shard:
    """One shard's file, and while it is being made its journal: a line for each point, and the numbers beside it."""

    def __init__(self, place: Path, points: _core.StudyPoints, number: int, count: int, tractions: bool) -> None:
        self.points = points
        self.indices = range(number - 1, points.points, count)
        self.file = place / f"shard-{number}-of-{count}.npz"
        self.kinds = _KINDS if tractions else _KINDS[:1]
        self.scene = Scene.parse(points.scene_text, file=points.scene_file)
        self.attributes = attributes_of(self.scene, ()) | {
            "study": points.hash,
            "title": points.title,
            "points": str(points.points),
            "axes": json.dumps(points.axes),
            "shard": f"{number}/{count}",
            "keep": " ".join(self.kinds),
            "tactile_net": _core.version,
            "instructions": _core.instructions,
        }

    def fill(self, jobs: int, heard: Any) -> None:
        with _locked(self.file.with_suffix(".lock")):
            if self._is_done():
                return
            lines = self._resumed()
            rest = self.indices[len(lines) :]
            with (
                open(self._part("jsonl"), "a", encoding="utf-8") as journal,
                self._numbers() as numbers,
                ThreadPoolExecutor(jobs) as pool,
            ):
                for index, found in _in_order(pool, self.points.simulate, rest, 4 * jobs):
                    lines.append(self._keep(index, found, lines, journal, numbers))
                    if heard is not None:
                        heard(f"{len(lines)} of {counted(len(self.indices), 'point')}")
            self._write(lines)

    def _part(self, suffix: str) -> Path:
        return self.file.with_suffix(f".part.{suffix}")

    @contextmanager
    def _numbers(self) -> Iterator[list[IO[bytes]]]:
        files: list[IO[bytes]] = [open(self._part(kind), "ab") for kind in self.kinds]
        try:
            yield files
        finally:
            for file in files:
                file.close()

    def _is_done(self) -> bool:
        if not self.file.exists():
            return False
        with np.load(self.file, allow_pickle=False) as arrays:
            told = json.loads(str(arrays["attributes"]))
        self._check(told, self.file)
        return True

    def _check(self, told: dict[str, str], path: Path) -> None:
        if _common(told) != _common(self.attributes):
            raise refused(
                fspath(path),
                "is of another study, version or set of instructions, or keeps other things",
                "a study that was changed begins in another folder",
            )

    def _resumed(self) -> list[dict[str, Any]]:
        """The points of an earlier call; what it has not written whole is cut off."""
        path = self._part("jsonl")
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        kept = text[: text.rfind("\n") + 1].splitlines()
        if kept:
            self._check(json.loads(kept[0]), path)
        else:
            kept = [json.dumps(self.attributes)]
        lines = [json.loads(line) for line in kept[1:]]
        while lines and any(
            not self._part(kind).exists() or self._part(kind).stat().st_size < lines[-1]["ends"][i]
            for i, kind in enumerate(self.kinds)
        ):
            lines.pop()  # of numbers that had not reached the disk
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(f"{line}\n" for line in [kept[0], *map(json.dumps, lines)])
        for i, kind in enumerate(self.kinds):
            with open(self._part(kind), "ab") as numbers:
                numbers.truncate(lines[-1]["ends"][i] if lines else 0)
        return lines

    def _keep(
        self, index: int, found: Point, lines: list[dict[str, Any]], journal: IO[str], numbers: list[IO[bytes]]
    ) -> dict[str, Any]:
        values, seed, readings, truth, failure = found
        ends = [0] * len(self.kinds) if not lines else list(lines[-1]["ends"])
        digest = sha256(f"{index} {seed} {failure}".encode())
        widths = [readings.shape[1], truth.shape[1]] if len(readings) > 0 else []
        shape: list[int] = next((line["widths"] for line in lines if line["widths"]), widths)
        if widths and widths != shape:
            raise refused(
                fspath(self.file),
                f"point {index} has {widths[0]} readings and {widths[1]} tractions, those before it {shape[0]} and {shape[1]}",
                "a data set has one shape: leave axes out that change taxels, and set reconstruct.spacing and margin where"
                " cells would follow the depth",
            )
        for i, values_of in enumerate((readings, truth)[: len(self.kinds)]):
            with np.errstate(over="ignore"):
                data = values_of.astype("<f4").tobytes()
            digest.update(data)
            numbers[i].write(data)
            numbers[i].flush()
            ends[i] += len(data)
        line = {
            "index": index,
            "values": values,
            "seed": seed,
            "failure": failure,
            "frames": len(readings),
            "widths": widths,
            "ends": ends,
            "digest": digest.hexdigest(),
        }
        journal.write(json.dumps(line) + "\n")
        journal.flush()
        return line

    def _write(self, lines: list[dict[str, Any]]) -> None:
        scene = self.scene
        widths = next((line["widths"] for line in lines if line["widths"]), None)
        if widths is None:
            why = lines[0]["failure"] if lines else "the shard has no point"
            raise refused(fspath(self.file), f"has no frame: {why}")
        if widths[0] != len(scene.reading_names):  # an axis has set the taxels for all points
            raise refused(
                fspath(self.file),
                f"points have {widths[0]} readings, and the study's scene {len(scene.reading_names)}",
                "let the scene have the taxels that the points have",
            )
        frames = np.array([line["frames"] for line in lines])
        arrays: dict[str, Any] = {"attributes": np.array(json.dumps(self.attributes))}
        readings = self._mapped("readings", int(frames.sum()), widths[0])
        arrays["readings"] = scene._framed(np.asarray(readings))
        if "tractions" in self.kinds:
            places = scene.traction_shape
            size = int(np.prod(places))
            if widths[1] % size != 0:
                raise refused(
                    fspath(self.file),
                    f"points have {widths[1]} tractions, which are none of the study's scene: it has {size} places",
                    "set reconstruct.spacing and reconstruct.margin in the scene",
                )
            truth = self._mapped("tractions", int(frames.sum()), widths[1])
            arrays["truth"] = truth.reshape(len(truth), widths[1] // size, *places)
        arrays["point"] = np.repeat([line["index"] for line in lines], frames)
        arrays["index"] = np.array([line["index"] for line in lines], dtype=np.int64)
        arrays["digest"] = np.array([line["digest"] for line in lines])
        for i, key in enumerate(self.points.axes):
            arrays[f"parameter:{key}"] = _column([line["values"][i] for line in lines])
        arrays["parameter:seed"] = np.array([line["seed"] for line in lines], dtype=np.int64)
        arrays["parameter:failure"] = np.array([line["failure"] for line in lines])
        with whole(fspath(self.file)) as to, open(to, "wb") as file:
            np.savez(file, **arrays)
        for suffix in ("jsonl", *self.kinds):
            self._part(suffix).unlink()

    def _mapped(self, kind: str, frames: int, width: int) -> NDArray[np.float32]:
        if frames * width == 0:
            return np.zeros((frames, width), dtype=np.float32)
        return np.memmap(self._part(kind), dtype="<f4", mode="r", shape=(frames, width))


def _column(values: list[str]) -> NDArray[Any]:
    try:
        return np.array([float(value) for value in values])
    except ValueError:
        return np.array(values)


def _in_order(pool: ThreadPoolExecutor, call: Any, indices: Sequence[int], ahead: int) -> Iterator[tuple[int, Any]]:
    """Answers in the order of the indices, with no more than so many under way: memory stays what it is."""
    from collections import deque

    waiting: deque[tuple[int, Any]] = deque()
    rest = iter(indices)
    try:
        for index in islice(rest, ahead):
            waiting.append((index, pool.submit(call, index)))
        while waiting:
            index, future = waiting.popleft()
            found = future.result()
            for following in islice(rest, 1):
                waiting.append((following, pool.submit(call, following)))
            yield index, found
    finally:
        for _, future in waiting:
            future.cancel()


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Ends with the process, however that ends."""
    with open(path, "w", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BlockingIOError(f"{path}: another process is at work on this shard") from None
        yield

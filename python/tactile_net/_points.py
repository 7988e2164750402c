"""Points of a study, some at a time, on threads of this process or by Dask."""

from __future__ import annotations

import math
import os
import random
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from . import _core
from ._optional import optional

Compute: TypeAlias = "Callable[[Any, list[int]], Any]"

_arrived: dict[str, tuple[tempfile.TemporaryDirectory[str], _core.StudyPoints]] = {}
_arriving = threading.Lock()


patience = 300.0  # [s] without a worker: more may be on their way
long_enough = 0.5  # [s] of a task, where there are points enough


class _NobodyLeft(Exception):
    pass


class StudyHere:
    """A study of this process."""

    def __init__(self, points: _core.StudyPoints) -> None:
        self._points = points

    def points(self) -> _core.StudyPoints:
        return self._points


@dataclass(frozen=True)
class StudyCopy:
    """A study that can be sent to other machines: its files by their absolute paths, and what it must be there."""

    path: str
    files: dict[str, bytes]
    allow_outside: bool
    version: str
    hash: str

    @staticmethod
    def of(path: str, points: _core.StudyPoints, allow_outside: bool) -> StudyCopy:
        study = os.path.abspath(path)
        names = [study, *map(os.path.abspath, (points.scene_file, *points.files))]
        files = {name: Path(name).read_bytes() for name in names if os.path.isfile(name)}
        return StudyCopy(study, files, allow_outside, _core.version, points.hash)

    def points(self) -> _core.StudyPoints:
        """The same study, read from its copy in a temporary folder of this process. Raises RuntimeError if it is another one."""
        with _arriving:
            if self.hash not in _arrived:
                if self.version != _core.version:
                    raise RuntimeError(
                        f"a worker has tactile-net {_core.version}, and the sweep {self.version}: install one version everywhere"
                    )
                folder = tempfile.TemporaryDirectory(prefix="tactile-net-study-")
                for name, content in self.files.items():
                    copy = Path(folder.name + name)
                    copy.parent.mkdir(parents=True, exist_ok=True)
                    copy.write_bytes(content)
                points = _core.StudyPoints(folder.name + self.path, self.allow_outside)
                if points.hash != self.hash:
                    folder.cleanup()
                    raise RuntimeError(
                        f"{self.path} is another study on a worker: name its scene and files by paths relative to it"
                    )
                if len(_arrived) == 8:
                    _arrived.pop(next(iter(_arrived)))[0].cleanup()  # the oldest
                _arrived[self.hash] = folder, points
            return _arrived[self.hash][1]


def computed(
    compute: Compute, study: StudyHere | StudyCopy, missing: Sequence[int], client: Any, threads: int | None
) -> Iterator[tuple[list[int], Any]]:
    """Some of the points, and what becomes of them, until all have come, in whatever order.

    study: a copy, where there is a client.
    client: a dask.distributed.Client; None: `threads` of this process, None: one for each processor. Points whose workers die
    are tried again, at last one at a time. It ends with points missing where that brought none, and where there has been no worker
    for five minutes.
    """
    left = set(missing)
    count = threads or len(os.sched_getaffinity(0))
    if client is not None:
        optional("dask.distributed", "dask")
        count = max(1, sum(client.nthreads().values()))
    size = 4 if client is None else 32
    tasks = 4 * count  # at the same time
    shuffled = random.Random(0).shuffle
    while left:
        rising = sorted(left)
        size = max(1, min(size, len(rising) // (16 * count)))
        parts = [rising[i : i + size] for i in range(0, len(rising), size)]
        if len(rising) < len(missing):
            shuffled(parts)  # so that points that kill, which lie together, do not hide those behind them
        come = _on_threads(compute, study, parts, count) if client is None else _by_dask(compute, study, parts, client, tasks)
        try:
            for part, found in come:
                left.difference_update(part)
                yield part, found
        except _NobodyLeft:
            return
        if len(left) == len(rising):
            if size == 1 and tasks == 1:
                return
            if size == 1:
                tasks = 1  # a point dies too whose worker was given one that kills
            size = 1


def _on_threads(
    compute: Compute, study: StudyHere | StudyCopy, parts: list[list[int]], threads: int
) -> Iterator[tuple[list[int], Any]]:
    rest = iter(parts)
    running: dict[Any, list[int]] = {}
    with ThreadPoolExecutor(threads) as pool:
        try:
            while True:
                while len(running) < 4 * threads and (part := next(rest, None)) is not None:
                    running[pool.submit(compute, study, part)] = part
                if not running:
                    return
                done = wait(running, return_when=FIRST_COMPLETED).done
                for future in [one for one in running if one in done]:
                    yield running.pop(future), future.result()
        finally:
            for future in running:
                future.cancel()


def _timed(compute: Compute, study: StudyHere | StudyCopy, part: list[int]) -> tuple[Any, float]:
    """What is computed, and in how many seconds a point."""
    begin = time.perf_counter()
    found = compute(study, part)
    return found, (time.perf_counter() - begin) / len(part)


def _joined(rest: deque[list[int]], tasks: int, seconds: float) -> list[int]:
    """The next part, with as many of those behind it as take `long_enough`, but no more than a share of `tasks`.

    Dask's own cost is milliseconds for each task. Points that are tried alone stay alone.

    seconds: that a point took.
    """
    part = rest.popleft()
    if len(part) > 1:
        most = min(len(part) * (1 + len(rest)) // tasks, long_enough / max(seconds, 1e-9))
        while rest and len(part) + len(rest[0]) <= most:
            part = part + rest.popleft()
    return sorted(part)


def _by_dask(
    compute: Compute, study: StudyHere | StudyCopy, parts: list[list[int]], client: Any, tasks: int
) -> Iterator[tuple[list[int], Any]]:
    """Without those whose workers died as often as the scheduler allows; ends after eight such in a row.

    tasks: at the same time.
    Raises _NobodyLeft.
    """
    distributed = optional("dask.distributed", "dask")
    rest = deque(parts)
    running: dict[Any, list[int]] = {}
    deaths, alone, seconds = 0, 0.0, math.inf
    try:
        while True:
            while len(running) < tasks and rest:
                part = _joined(rest, tasks, seconds)
                running[client.submit(_timed, compute, study, part, pure=False)] = part
            if not running:
                return
            try:
                done = distributed.wait(list(running), timeout=1.0, return_when="FIRST_COMPLETED").done
            except TimeoutError:
                alone = 0.0 if client.nthreads() else alone + 1.0
                if alone >= patience:
                    raise _NobodyLeft from None
                continue
            for future in [one for one in running if one in done]:
                part = running.pop(future)
                try:
                    found, seconds = future.result()
                except distributed.KilledWorker:
                    deaths += 1
                    continue
                deaths = 0
                yield part, found
            if deaths >= 8:
                return
    finally:
        client.cancel(list(running))

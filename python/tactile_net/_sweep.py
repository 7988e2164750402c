"""A scene at many values: studies, sweeps on this machine or on a cluster, and their rows as arrays."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from os import PathLike, fspath
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _html
from ._documents import Document
from ._optional import optional
from ._points import StudyCopy, computed
from ._progress import Progress, listening
from ._refusal import counted, refused
from ._toml import text_of

if TYPE_CHECKING:
    from ._scene import Scene

__all__ = ["Study", "SweepTable", "merge", "sweep"]

_WHOLE = ("index", "seed")
_WORDS = ("method", "verdict", "failure", "version", "instructions")
_LISTS = ("readings", "truth", "tractions")


@dataclass(frozen=True)
class Study:
    """A scene and its axes: `{"sensor.depth": [1e-3, 2e-3], "noise.rms": {"from": 1, "to": 100, "count": 5, "scale": "log"}}`.

    An axis is a list of values, or a range as docs/sweeps.md says; ranges without a count are drawn, as `draw` says:
    `{"kind": "sobol", "count": 64}`. `keep`: which columns the rows have, `["error", "tractions"]`; None: the usual ones.
    """

    scene: Scene
    axes: Mapping[str, Sequence[Any] | NDArray[Any] | Mapping[str, Any]]
    seed: int = 1
    repeats: int = 1
    draw: Mapping[str, Any] | None = None
    title: str = ""
    keep: Sequence[str] | None = None
    _names: tuple[str, str] = field(default=("study.toml", "scene.toml"), repr=False)

    def save(self, folder: str | PathLike[str]) -> str:
        """Writes study.toml, and the scene beside it; returns the path of the study."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        study, scene = self._names
        axes = [
            {"key": key, **(values if isinstance(values, Mapping) else {"values": list(values)})}
            for key, values in self.axes.items()
        ]
        table: dict[str, Any] = {"title": self.title or None, "scene": scene, "seed": self.seed, "repeats": self.repeats}
        table["keep"] = None if self.keep is None else list(self.keep)
        text = text_of(table | {"draw": self.draw, "axis": axes})
        (place / scene).write_text(self.scene.text, encoding="utf-8")
        (place / study).write_text(text, encoding="utf-8")
        return fspath(place / study)


class SweepTable(Document):
    """The rows of a sweep, one for each point and method: `table["error"]` is an array, an axis is known by its key.

    What is not known is NaN, or an empty text. Lists that were kept, `table["tractions"]`, have a row for each; where they are
    not equally long, they are an array of arrays.
    """

    axes: tuple[str, ...]
    units: dict[str, str | None]
    """Of the axes, as the scene's [units] states them; None: it states none, or there is none."""
    sha256: str
    """Of `csv`: the same whoever computed what, on machines of one set of instructions."""

    def __init__(self, core: _core.SweepTable, resumed: int | None = None) -> None:
        self._core: _core.SweepTable = core
        self._json = core.json(resumed)
        self.title = core.title
        self.points = core.points
        self.axes = tuple(core.axes)
        self.units = {axis: unit or None for axis, unit in zip(self.axes, core.units, strict=True)}
        self.sha256 = core.sha256
        head, *rows = csv.reader(io.StringIO(core.csv))
        self.columns: dict[str, NDArray[Any]] = {
            name: _column(name, [row[i] for row in rows]) for i, name in enumerate(head)
        }

    @property
    def csv(self) -> str:
        """What results.csv holds."""
        return self._core.csv

    def __len__(self) -> int:
        return len(self.columns["index"])

    def __getitem__(self, column: str) -> NDArray[Any]:
        return self.columns[column]

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with the same columns."""
        return optional("pandas", "tables").DataFrame(
            {name: list(values) if name in _LISTS else values for name, values in self.columns.items()}
        )

    def to_parquet(self, path: str | PathLike[str]) -> None:
        """Writes the columns as Parquet; title, axes, hash and the JSON document stand in the file's metadata."""
        arrow = optional("pyarrow", "tables")
        about = {
            "tactile_net.title": self.title,
            "tactile_net.sha256": self.sha256,
            "tactile_net.axes": "\n".join(self.axes),
            "tactile_net.json": self.to_json(),
        }
        table = arrow.table(
            {name: arrow.array(list(values) if name in _LISTS else values) for name, values in self.columns.items()}
        )
        optional("pyarrow.parquet", "tables").write_table(table.replace_schema_metadata(about), fspath(path))

    def report(self, folder: str | PathLike[str], *, force: bool = False) -> str:
        """Writes results.csv, result.json and the page that the command writes; returns the path of report.html.

        Raises OSError where a report.html stands that tactile-net has not written, unless `force`.
        """
        self._core.report(self._json, fspath(folder), force)
        return f"{fspath(folder)}/report.html"

    def __repr__(self) -> str:
        return f"SweepTable({self.title!r}, {self.points} points, {len(self)} rows, axes {', '.join(self.axes)})"

    def _repr_html_(self) -> str:
        return _html.paragraphs((f"{self.title}: {self.points} points",)) + _html.table(self._core.cells())


def _column(name: str, fields: list[str]) -> NDArray[Any]:
    if name in _LISTS:
        return _lists([np.array([float(number) for number in text.split()]) for text in fields])
    if name in _WHOLE:
        return np.array([int(text) for text in fields], dtype=np.int64)
    if name not in _WORDS:
        try:
            return np.array([float(text) if text else np.nan for text in fields])
        except ValueError:
            pass  # an axis of words
    return np.array(fields)


def _lists(rows: list[NDArray[Any]]) -> NDArray[Any]:
    """One array where all that are there are equally long; of a row without one, NaN."""
    lengths = {len(row) for row in rows if len(row) > 0}
    if len(lengths) == 1:
        nothing = np.full(lengths.pop(), np.nan)
        return np.array([row if len(row) > 0 else nothing for row in rows])
    uneven = np.empty(len(rows), dtype=object)
    uneven[:] = rows
    return uneven


def sweep(
    study: Study | str | PathLike[str],
    out: str | PathLike[str],
    *,
    jobs: int | None = None,
    points: tuple[int, int] | None = None,
    allow_outside: bool = False,
    progress: Progress = False,
    client: Any = None,
) -> SweepTable | None:
    """Computes what of a study is not done yet, and appends it to the file of rows `out`, which the command reads and writes too.

    jobs: how many points at once on this machine; None: one for each processor. client: a dask.distributed.Client, whose
    workers compute in place of this machine; they need tactile-net, and no file of it. A sweep that is interrupted, or killed,
    goes on where it was. Returns the rows; None for a part: `points=(0, 100)` are the first hundred, and `merge` puts parts
    together.

    Raises InputError for a study that is none, or another one than the file's; OSError where another sweep writes into the file,
    or nothing can be written there; RuntimeError, naming the points that are missing, where workers died of them.
    """
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs must be at least 1 (got {jobs})")
    if jobs is not None and client is not None:
        raise ValueError("jobs is for this machine, and client has workers of its own: give one of them")
    first, end = (0, None) if points is None else points
    if first < 0 or (end is not None and end <= first):
        raise ValueError(f"points must be (A, B) with 0 <= A < B (got {points})")
    with saved(study) as path, listening(progress) as heard:
        if client is None:
            earlier = _core.sweep(path, fspath(out), jobs, first, end, allow_outside, heard).earlier
        else:
            earlier = _by_dask(path, fspath(out), first, end, allow_outside, heard, client)
    return SweepTable(_core.merge([fspath(out)]), earlier) if points is None else None


def _by_dask(
    path: str, out: str, first: int, end: int | None, allow_outside: bool, heard: Any, client: Any
) -> int:
    """Returns how many points were there before."""
    study = _core.StudyPoints(path, allow_outside)
    if first >= study.points:
        raise refused(path, f"has {study.points} points, and none from {first} on", "points are counted from 0")
    done = 0
    with closing(_core.RowsFile(study, out)) as file:
        missing = file.missing(first, end)
        copy = StudyCopy.of(path, study, allow_outside)
        for part, lines in computed(_rows, copy, missing, client, None):
            file.append(lines)
            done += len(part)
            if heard is not None:
                heard(f"{done} of {counted(len(missing), 'point')}")
    if done < len(missing):
        try:
            _core.merge([out], first, end)
        except RuntimeError as which:
            raise RuntimeError(f"workers died of points that they were given; {which}") from None
    return (study.points if end is None else min(end, study.points)) - first - len(missing)


def _rows(study: StudyCopy, indices: list[int]) -> str:
    return study.points().rows(indices)


@contextmanager
def saved(study: Study | str | PathLike[str]) -> Iterator[str]:
    """The path of a study, which is written into a temporary folder where it is no file."""
    if not isinstance(study, Study):
        yield fspath(study)
        return
    with TemporaryDirectory(prefix="tactile-net-study-") as folder:
        yield study.save(folder)


def merge(*files: str | PathLike[str]) -> SweepTable:
    """The rows of a sweep, from all files of it. Raises RuntimeError where points are missing, and says which."""
    return SweepTable(_core.merge([fspath(file) for file in files]))

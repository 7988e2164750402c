"""A scene at many values: studies, sweeps on this machine or on a cluster, and their rows as arrays."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, _html
from ._documents import Document
from ._optional import optional
from ._progress import Progress, listening
from ._toml import text_of

if TYPE_CHECKING:
    from ._scene import Scene

__all__ = ["Study", "SweepTable", "merge", "slurm_script", "sweep"]

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
    shard: tuple[int, int] = (1, 1),
    allow_outside: bool = False,
    progress: Progress = False,
) -> SweepTable | None:
    """Computes what of a study is not done yet, on `jobs` processors (None: all), with a journal in the folder `out`.

    A sweep that is interrupted, or killed, goes on where it was. Returns the rows; None for a part: `shard=(3, 8)` is the
    third of eight, and `merge` puts them together. A study that is no file is written into `out`.

    Raises InputError for a study that is none, or another one than the folder's; OSError where another sweep is at work in
    the folder, or nothing can be written there.
    """
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs must be at least 1 (got {jobs})")
    path = study.save(out) if isinstance(study, Study) else fspath(study)
    with listening(progress) as heard:
        done = _core.sweep(path, fspath(out), jobs, f"{shard[0]}/{shard[1]}", allow_outside, heard)
    return SweepTable(_core.merge([fspath(out)]), done.earlier) if tuple(shard) == (1, 1) else None


def merge(*folders: str | PathLike[str]) -> SweepTable:
    """The rows of a sweep, from the folders of all its shards. Raises RuntimeError where points are missing."""
    return SweepTable(_core.merge([fspath(folder) for folder in folders]))


def slurm_script(
    study: str | PathLike[str], out: str | PathLike[str], tasks: int, time: str = "1:00:00"
) -> str:
    """A job file for Slurm: an array of so many tasks, each a shard of the study; `time` is that of one task."""
    return _core.slurm_script(os.path.abspath(study), os.path.abspath(out), tasks, time)

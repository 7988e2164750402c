"""Many recordings of one sensor side by side: which to look at first."""

from __future__ import annotations

import time
from collections.abc import Iterable
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _core
from ._documents import Document
from ._optional import optional
from ._progress import Progress
from ._refusal import refused
from .errors import InputError, UnsolvableError

if TYPE_CHECKING:
    from ._scene import Scene

__all__ = ["Report", "report"]


class Report(Document):
    """A row for each recording, the most suspicious first. Made by `tactile_net.report`."""

    scene: Scene
    rows: list[dict[str, Any]]
    """What is known of each recording; docs/results.md says what the keys hold."""
    csv: str
    """The same rows, as the command's recordings.csv has them."""

    def __init__(self, scene: Scene, rows: list[_core.RecordingRow]) -> None:
        self.scene = scene
        self._json, self.csv = _core.report(scene._core, rows)
        self.rows = self.to_dict()["recordings"]

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        fine = sum(row["standing"] == "fine" for row in self.rows)
        return f"<Report of {len(self)} recordings: {fine} fine>"

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame, a recording a row: it has `to_csv` and `to_parquet`."""
        return optional("pandas", "tables").DataFrame(self.rows)


def report(
    recordings: str | PathLike[str] | Iterable[str | PathLike[str]],
    scene: Scene,
    *,
    columns: str = "",
    missing: Literal["fail", "skip", "estimate"] = "fail",
    progress: Progress = False,
) -> Report:
    """Solves many recordings of one scene's sensor and says which to look at first, as `tactile-net report` does.

    recordings: files, CSV or .npy, and folders that hold some.
    columns: as of `Scene.read`; missing: as of `Scene.solve`.
    A file that cannot be read or solved is a row that says why.

    Raises InputError for a path that is not there, and for a folder without a .csv or .npy.
    """
    rows: list[_core.RecordingRow] = []
    for path in _files(recordings):
        begin = time.monotonic()
        rows.append(_row(path, scene, columns, missing, progress))
        rows[-1].seconds = time.monotonic() - begin
    return Report(scene, rows)


def _files(recordings: str | PathLike[str] | Iterable[str | PathLike[str]]) -> list[str]:
    """Each file once."""
    given = [recordings] if isinstance(recordings, (str, PathLike)) else recordings
    files: dict[Path, str] = {}
    for one in given:
        path = Path(one)
        found = [path]
        if path.is_dir():
            found = sorted(inside for inside in path.iterdir() if _is_recording(inside))
            if not found:
                raise refused(fspath(one), "holds no file that ends in .csv or .npy", "give the files themselves")
        elif not path.exists():
            raise refused(fspath(one), "is not there", "name a recording, or a folder of some")
        for file in found:
            files.setdefault(file.resolve(), fspath(file))
    return list(files.values())


def _is_recording(path: Path) -> bool:
    """A hidden one is the system's own."""
    return path.suffix.lower() in {".csv", ".npy"} and not path.name.startswith(".") and not path.is_dir()


def _row(
    path: str, scene: Scene, columns: str, missing: Literal["fail", "skip", "estimate"], progress: Progress
) -> _core.RecordingRow:
    try:
        recording = scene.read(path, columns=columns, missing=missing != "fail")
        return scene.solve(recording, missing=missing, progress=progress)._row(path)
    except InputError as error:
        if error.diagnostics:
            first = error.diagnostics[0]
            return _core.failed_row(path, first.line or 0, first.message, first.hint)
        return _core.failed_row(path, 0, str(error), "")
    except (ValueError, UnsolvableError, OSError) as error:
        return _core.failed_row(path, 0, str(error), "")

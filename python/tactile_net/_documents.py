"""What the command writes of a result: JSON, and a page."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any

from ._told import Told, parsed


class Document:
    """A result that has the JSON of its command."""

    _json: str

    def to_json(self) -> str:
        """As the command's `--json` writes it, without times."""
        return self._json

    def to_dict(self) -> dict[str, Any]:
        document: dict[str, Any] = parsed(self.to_json())
        return document

    @property
    def told(self) -> Told:
        """Every number of that JSON as an attribute: `result.told.scene`. `tactile_net.keys` says what each is."""
        return Told(self.to_dict())


class PagedDocument(Document):
    """One with a page, which its core draws: that is not pickled, but made again."""

    _core: Any | None

    def _drawable(self) -> Any:
        """The core, fit to draw the page."""
        raise NotImplementedError

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_core": None}

    def report(self, folder: str | PathLike[str], *, force: bool = False) -> str:
        """Writes the page that the command's `--out` writes, and returns the path of report.html.

        Raises OSError where a report.html stands that tactile-net has not written, unless `force`.
        """
        self._core = self._drawable()
        self._core.report(fspath(folder), force)
        return f"{fspath(folder)}/report.html"

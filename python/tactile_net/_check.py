"""A recording looked at before it is trusted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _core, _html
from ._documents import Document
from ._progress import Progress, listening

if TYPE_CHECKING:
    from ._recording import Recording
    from ._scene import Scene

__all__ = ["Finding", "ReadingsCheck"]


class Finding(NamedTuple):
    """Something suspicious."""

    what: str
    advice: str
    """What to write, or to do."""
    kind: str
    """Its name, such as `dead_taxels`: the table in check.md has them all."""
    numbers: dict[str, Any]
    """The numbers of its kind, by the names in that table."""


class ReadingsCheck(Document):
    """Whether a recording fits its scene. Made by `Scene.check`."""

    scene: Scene
    findings: tuple[Finding, ...]
    """Empty: nothing looks wrong."""
    understood: tuple[str, ...]
    """What the recording holds, a sentence each."""

    def __init__(self, recording: Recording, name: str, progress: Progress = False) -> None:
        self.scene = recording.scene
        rows, _ = self.scene._rows(recording.readings)
        times = [] if recording.t is None else recording.t.tolist()
        with listening(progress) as heard:
            core = _core.check(self.scene._core, times, np.ascontiguousarray(rows), heard)
        self.understood = tuple(core.understood())
        self._text = core.text()
        self._json = core.json(name)
        self.findings = tuple(
            Finding(one.pop("text"), one.pop("advice"), one.pop("kind"), one) for one in self.to_dict()["findings"]
        )

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<ReadingsCheck of {self.scene.file}: {len(self.findings)} suspicious>"

    def _repr_html_(self) -> str:
        rows = [(one.what, one.advice) for one in self.findings]
        return _html.paragraphs(self.understood) + _html.table([("suspicious", "what to do"), *rows])

"""The one layout of recorded frames: arrays under fixed names, and attributes that are text, in every container.

readings (T, C, N), of skins (T, rows, columns, C), of uneven arrays (T, R); t (T) [s], where times are known; channels (C)
and y (N), of skins z too, of uneven arrays of each reading; truth (T, U, M), of skins (T, 3, rows, columns); of a solution
tractions of that shape, alpha, verdict and data (T), of skins also deviation and what each frame amounts to.
"""

from __future__ import annotations

import atexit
import dataclasses
import json
import os
import shutil
import tempfile
from collections.abc import Sequence
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._recording import Recording, Solution
from ._refusal import refused
from ._skin_solution import EARLIER, SkinSolution

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray

    from ._scene import Scene

READINGS, TRACTIONS = "tactile_net.readings", "tactile_net.tractions"
VERSION = 1
SIGNS = "compression is positive, and drag along +y; frames, channels, taxels"
SKIN_SIGNS = "compression is positive, drags along +y and +z; frames, rows, columns, channels"
OF_SKINS = (
    "wrench",
    "wrench_deviation",
    "wrench_covariance",
    "ellipse",
    "ellipse_deviation",
    "space",
    "space_deviation",
    "touching",
    "contacts",
)
OF_FRAMES = ("t", "readings", "truth", "tractions", "deviation", "alpha", "verdict", "data", *OF_SKINS)
"""Arrays with a row for each frame."""


@dataclasses.dataclass
class Layout:
    """What a container holds; without attributes it is a stranger's."""

    arrays: dict[str, NDArray[Any]]
    attributes: dict[str, str] = dataclasses.field(default_factory=dict)
    units: str | None = None
    """That a stranger's file states."""
    columns: list[str] | None = None
    """Of a stranger's readings that stand in a column each."""
    notes: list[str] = dataclasses.field(default_factory=list)
    """What was found while reading."""
    seconds: bool = False
    """A stranger's times are that for certain."""

    @property
    def own(self) -> bool:
        return self.attributes.get("format") in (READINGS, TRACTIONS)


def units_by_channel(scene: Scene) -> dict[str, str]:
    """ "Pa", of strains "1", of displacements "m"; "": the scene states none."""
    return {name: _unit_of(name) if scene._core.si else "" for name in dict.fromkeys(scene.channels)}


def _unit_of(channel: str) -> str:
    kinds = {"strain": "1", "shear_strain": "1", "displacement": "m"}
    return next((unit for kind, unit in kinds.items() if channel.startswith(kind)), "Pa")


def attributes_of(scene: Scene, notes: Sequence[str]) -> dict[str, str]:
    """Of its readings, in every container."""
    return {
        "format": READINGS,
        "version": str(VERSION),
        "signs": SIGNS if len(scene._surface[0]) == 1 else SKIN_SIGNS,
        "units": json.dumps(units_by_channel(scene)),
        "scene": scene.text,
        "scene_file": os.path.basename(scene.file),
        "scene_files": json.dumps(_files_of(scene)),
        "scene_sha256": sha256(scene.text.encode()).hexdigest(),
        "notes": json.dumps(notes),
    }


def layout_of(what: Recording | Solution, dtype: DTypeLike = np.float64) -> Layout:
    """Raises ValueError where a number is too large for `dtype`."""
    recording = what.recording if isinstance(what, Solution) else what
    scene = recording.scene
    even = scene.even
    arrays: dict[str, Any] = {"readings": recording.readings, "truth": recording.truth}
    attributes = attributes_of(scene, recording.notes)
    if isinstance(what, Solution):
        arrays |= what._held()
        attributes |= {
            "format": TRACTIONS,
            "method": what.method,
            "missing": what._missing,
            "share_alpha": json.dumps(what._share_alpha),
            "solution_notes": json.dumps(what.notes),
        }
    held = {name: as_dtype(dtype, name, values) for name, values in arrays.items() if values is not None}
    if recording.t is not None:
        held["t"] = recording.t
    held["channels"] = np.array(scene.channels if even else scene.reading_names)
    held |= scene._places
    if isinstance(what, Solution):
        held |= {"verdict": what.verdict, "data": what.data}
    return Layout(held, attributes)


def as_dtype(dtype: DTypeLike, name: str, values: NDArray[Any]) -> NDArray[Any]:
    if np.dtype(dtype) not in (np.float32, np.float64):
        raise ValueError(f"dtype must be float64 or float32 (got {np.dtype(dtype)})")
    if values.dtype.kind != "f":
        return values
    with np.errstate(over="ignore"):
        held = values.astype(dtype)
    if np.isinf(held).sum() != np.isinf(values).sum():
        raise ValueError(f"{name} cannot be held as float32, whose largest is 3e38: save it as float64")
    return held


def _files_of(scene: Scene) -> dict[str, str]:
    """The text of the files that it refers to."""
    tables = scene.to_dict()
    named = tables["sensor"].get("taxels"), tables.get("calibration", {}).get("file")
    folder = Path(scene.file).parent
    return {name: (folder / name).read_text(encoding="utf-8") for name in named if name is not None}


@cache
def _unpacked(files: tuple[tuple[str, str], ...]) -> str:
    """A folder with these files, for as long as the process lives: a scene reads them whenever it is parsed."""
    folder = tempfile.mkdtemp(prefix="tactile_net-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    for name, text in files:
        path = Path(folder, name)
        if not path.resolve().is_relative_to(Path(folder).resolve()):
            raise ValueError(f"{name!r} leads out of the scene's folder")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def scene_in(layout: Layout, where: str) -> Scene:
    """The scene inside, with the files that it refers to."""
    from ._scene import Scene

    attributes = layout.attributes
    if int(attributes.get("version", "0")) > VERSION:
        raise refused(
            where,
            f"is of version {attributes['version']} of the layout, and versions up to {VERSION} are read here",
            "a newer tactile-net reads it",
        )
    text = attributes.get("scene", "")
    if sha256(text.encode()).hexdigest() != attributes.get("scene_sha256"):
        raise refused(
            where, "has a scene inside that is not the one it was saved with: its SHA-256 differs", "give scene="
        )
    files = json.loads(attributes.get("scene_files", "{}"))
    try:
        folder = _unpacked(tuple(sorted(files.items()))) if files else os.path.dirname(where)
        return Scene.parse(text, file=os.path.join(folder, os.path.basename(attributes.get("scene_file", "scene"))))
    except ValueError as error:
        raise refused(where, f"has a scene inside that cannot be read:\n{error}", "give scene=") from None


_TEXTS = {"verdict", "data"}


def solution_in(layout: Layout, recording: Recording, where: str) -> Solution:
    """What was saved of a solution, without solving again."""
    if layout.attributes.get("format") != TRACTIONS:
        raise refused(where, "holds readings and no solution", "tactile_net.load(path).solve()")
    arrays, attributes = layout.arrays, layout.attributes
    kind: type[Solution] = SkinSolution if len(recording.scene.traction_shape) > 1 else Solution
    return kind._restored(
        recording=recording,
        method=attributes["method"],
        _missing=attributes["missing"],
        _share_alpha=json.loads(attributes["share_alpha"]),
        held={
            name: np.asarray(arrays[name], dtype=np.float64)
            for name in (*OF_FRAMES, EARLIER)
            if name in arrays.keys() - _TEXTS
        },
        verdict=np.asarray(arrays["verdict"], dtype=np.str_),
        data=np.asarray(arrays["data"], dtype=np.str_),
        notes=tuple(json.loads(attributes["solution_notes"])),
    )

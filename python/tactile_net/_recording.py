"""Frames of readings, and what they were solved to."""

from __future__ import annotations

import dataclasses
from functools import cached_property
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _html
from ._arrays import Floats
from ._documents import Document
from ._told import ContactPatch, followed_patches
from ._optional import optional
from ._progress import Progress, listening

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, DTypeLike, NDArray

    from ._check import ReadingsCheck
    from ._layout import Layout
    from ._scene import Scene

__all__ = ["Distribution", "Recording", "Solution"]


class Distribution:
    """All that the readings of each frame leave possible of one number: `Solution.distribution`."""

    def __init__(self, solved: Any, what: str):
        self._solved = solved
        self._what = what
        self.quantile([0.5])  # refuses what has none

    def quantile(self, p: ArrayLike) -> Floats:
        """(T, P), of what a skin has along y and z (T, 2, P): the values with these probabilities below them. ValueError
        where one is not between 0 and 1, both excluded."""
        probabilities = [float(one) for one in np.atleast_1d(np.asarray(p, dtype=float))]
        found = np.asarray(self._solved.quantiles(self._what, probabilities))
        return found[:, 0] if found.shape[1] == 1 else found

    def interval(self, level: float = 0.95) -> Floats:
        """(T, 2), of what a skin has along y and z (T, 2, 2): the ends of the central interval with this probability.
        ValueError where it is not between 0 and 1, both excluded."""
        if not 0.0 < level < 1.0:
            raise ValueError(f"level must be between 0 and 1, both excluded, but is {level!r}")
        return self.quantile([0.5 - 0.5 * level, 0.5 + 0.5 * level])

    def __repr__(self) -> str:
        return f"<Distribution of {self._what}>"


@dataclasses.dataclass(frozen=True, eq=False)
class Recording:
    """Frames of one scene's sensor, simulated or read from a file."""

    scene: Scene
    readings: Floats
    """(T, C, N): frames, channels, taxels; of skins (T, rows, columns, C); of uneven arrays (T, R): frames, readings."""
    t: Floats | None = None
    """Of each frame [s]; None: the file has no times."""
    truth: Floats | None = None
    """(T, U, M), of skins (T, 3, rows, columns): the tractions that pressed [Pa]; None where nobody knows."""
    notes: tuple[str, ...] = ()
    """What was taken for granted, or cut off."""

    @property
    def y(self) -> Floats:
        """Of the tractions [m]."""
        return self.scene.y

    @property
    def taxels(self) -> Floats:
        """y of the taxels, of skins y and z [m]."""
        return self.scene.taxels

    def __len__(self) -> int:
        return len(self.readings)

    def __repr__(self) -> str:
        return f"<Recording of {len(self)} frames of {self.readings[0:1].size} readings>"

    def solve(self, method: str = "tikhonov", **options: Any) -> Solution:
        """As `Scene.solve`."""
        return self.scene.solve(self, method, **options)

    def check(self, **options: Any) -> ReadingsCheck:
        """As `Scene.check`."""
        return self.scene.check(self, **options)

    def save(
        self, path: str | PathLike[str], *, name: str | None = None, dtype: DTypeLike = np.float64, append: bool = False
    ) -> None:
        """A file that `tactile_net.load` reads: .npz, .csv, .nc or .h5 (netCDF-4), .zarr, .parquet, .mcap; .npy of the
        readings alone.

        All but .npy hold the scene, units, times and the truth. The file is whole or not there.
        name: of the group in netCDF-4 and Zarr (None: the root), the topic in MCAP (None: "pad"). append: to a file of
        netCDF-4 or a Zarr that holds others.
        dtype: "float32" takes half the space, of numbers up to 3e38.
        Raises ValueError where the container cannot hold the recording, or its times go back.
        """
        from . import _files

        _files.save(self, path, name, dtype, append)

    def _layout(self, dtype: DTypeLike = np.float64) -> Layout:
        from ._layout import layout_of

        return layout_of(self, dtype)

    def to_xarray(self) -> Any:
        """An xarray.Dataset: `readings` over (t, channel, taxel), `truth` over (t, component, y); of skins `readings`
        over (t, row, column, channel), `truth` over (t, component, y, z).

        Without times t counts the frames. Attributes are text: the scene, units, notes.
        """
        from ._exchange import dataset_of

        return dataset_of(self._layout(), self.scene)

    @classmethod
    def from_xarray(cls, dataset: Any, *, scene: Scene | None = None, units: Any = None) -> Recording:
        """The recording of a Dataset as `to_xarray` makes it; scene, units: of another's, as of `tactile_net.load`."""
        from ._exchange import layout_in
        from ._judge import judged

        return judged(layout_in(dataset), "dataset", scene, units, True)

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame, a frame a row, a reading a column, over t."""
        pandas = optional("pandas", "tables")
        index = None if self.t is None else pandas.Index(self.t, name="t")
        rows, _ = self.scene._rows(self.readings)
        return pandas.DataFrame(rows, index=index, columns=list(self.scene.reading_names))


class Solution(Document):
    """Tractions of every frame, and how far to trust them. Made by `Scene.solve`."""

    recording: Recording
    method: str
    tractions: Floats
    """(T, U, M) [Pa]: normal, then tangential; nan where a frame has no answer."""
    data: NDArray[np.str_]
    """Of each frame's readings: "ok", "noise_unknown", or why no contact can have caused them."""
    alpha: Floats
    """Of each frame; nan where the method has none."""
    notes: tuple[str, ...]

    def __init__(
        self, recording: Recording, method: str, missing: str, share_alpha: int | None, progress: Progress = False
    ) -> None:
        self.recording = recording
        self.method = method
        self._missing = missing
        self._share_alpha = share_alpha
        core = self._solve(progress)
        self._core: _core.SolvedRecording | None = core
        self._know(core)
        self.notes = tuple(core.notes())

    def _know(self, core: _core.SolvedRecording) -> None:
        """What is known of every frame."""
        self.tractions = self._shaped(core.tractions())
        self.data = np.array(core.data(), dtype=np.str_)
        self.alpha = core.alpha()

    def _solve(self, progress: Progress = False) -> _core.SolvedRecording:
        recording = self.recording
        times = [] if recording.t is None else recording.t.tolist()
        scene = recording.scene
        rows = np.ascontiguousarray(scene._ordered(recording.readings), dtype=np.float64)
        with listening(progress) as heard:
            return _core.solve(scene._core, self.method, self._missing, self._share_alpha, times, rows, heard)

    def _solved(self) -> _core.SolvedRecording:
        if self._core is None:  # it was pickled, as arrays
            self._core = self._solve()
        return self._core

    def _row(self, name: str) -> _core.RecordingRow:
        """What the recording amounts to beside others."""
        return self._solved().row(name)

    def _shaped(self, rows: Floats) -> Floats:
        return rows.reshape(len(rows), rows.shape[1] // len(self.y), len(self.y))

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_core": None}

    def _held(self) -> dict[str, Floats]:
        """The numbers that a file keeps."""
        return {"tractions": self.tractions, "alpha": self.alpha}

    @classmethod
    def _restored(cls, held: dict[str, Floats], **state: Any) -> Solution:
        """held: `_held` of the one that was saved, and perhaps more of the file's."""
        solution = cls.__new__(cls)
        solution.__dict__.update(state, _core=None, tractions=held["tractions"], alpha=held["alpha"])
        return solution

    def save(
        self, path: str | PathLike[str], *, name: str | None = None, dtype: DTypeLike = np.float64, append: bool = False
    ) -> None:
        """As `Recording.save`, with tractions, verdicts and alpha beside the recording: .npz, .nc or .h5, .zarr; the
        latter hold deviations too.

        .mcap is for viewers: tractions and force are topics beside that of the readings.
        """
        from . import _files

        _files.save(self, path, name, dtype, append)

    @classmethod
    def load(cls, path: str | PathLike[str], *, name: str | None = None) -> Solution:
        """What `save` wrote, without solving again. Raises InputError where the file holds no solution."""
        from . import _files

        return _files.load_solution(path, name)

    @property
    def scene(self) -> Scene:
        return self.recording.scene

    @property
    def y(self) -> Floats:
        """Of the tractions [m]."""
        return self.scene.y

    @property
    def t(self) -> Floats | None:
        return self.recording.t

    @cached_property
    def _known(self) -> tuple[Floats, Floats, Floats, Floats, str, list[str]] | None:
        return self._solved().bands()

    @property
    def _bands(self) -> tuple[Floats, Floats, Floats, Floats] | None:
        return None if self._known is None else self._known[:4]

    @cached_property
    def verdict(self) -> NDArray[np.str_]:
        """Of each frame: "ok", or what is wrong with the answer; "missing": there is none. Where the method has bands it
        knows how sure the force is: they are computed when it is first asked for."""
        return np.array(self._solved().verdict() if self._known is None else self._known[5], dtype=np.str_)

    @property
    def has_bands(self) -> bool:
        """Whether the method knows how sure it is: tikhonov and closed_form do."""
        return self._bands is not None

    def _band(self, which: int) -> Floats:
        if self._bands is None:
            raise ValueError(f"{self.method} knows no deviation of its answers: tikhonov and closed_form do")
        return self._bands[which]

    @property
    def deviation(self) -> Floats:
        """(T, U, M): one standard deviation of each traction [Pa]. Computed when first asked for.

        It holds what noise and smoothing do, if pad and noise are as the scene says. ValueError without `has_bands`; so
        do the next deviations.
        """
        return self._shaped(self._band(0))

    @property
    def normal_force(self) -> Floats:
        """(T,) [N/m]"""
        return np.asarray(self.scene.spacing * self.tractions[:, 0].sum(axis=1))

    @property
    def normal_force_deviation(self) -> Floats:
        """(T,): one standard deviation [N/m]"""
        return self._band(1)[:, 1]

    @property
    def tangential_force(self) -> Floats:
        """(T,) [N/m]; nan where only normal tractions are solved for."""
        if self.tractions.shape[1] == 1:
            return np.full(len(self), np.nan)
        return np.asarray(self.scene.spacing * self.tractions[:, 1].sum(axis=1))

    @property
    def tangential_force_deviation(self) -> Floats:
        """(T,): one standard deviation [N/m]; nan as above."""
        return self._band(2)[:, 1]

    @property
    def centre(self) -> Floats:
        """(T,): where the normal force acts [m]; nan where nothing presses."""
        moment = self.scene.spacing * (self.tractions[:, 0] * self.y).sum(axis=1)
        force = self.normal_force
        return np.asarray(np.divide(moment, force, out=np.full_like(force, np.nan), where=force > 0))

    @property
    def centre_deviation(self) -> Floats:
        """(T,): one standard deviation [m]; nan as above."""
        return self._band(3)[:, 1]

    def interval(self, what: str, level: float = 0.95) -> Floats:
        """The ends of the central interval of "normal_force", "tangential_force" [N/m, of skins N] or "centre" [m] that
        holds it with this probability: (T, 2), of what skins have along y and z (T, 2, 2), as the attribute and the ends
        behind it. nan where a frame has no answer, or one alpha's as that of a skin whose load reaches beyond what taxels
        see, or it was not solved for, and of the centre where nothing presses.

        ValueError where there is no such name, the level is not between 0 and 1, or every answer is one alpha's: the scene
        states an alpha, nobody knows the noise, or a skin's taxels are not dense and its scene does not say
        `answer = "mixture"`.
        """
        return self.distribution(what).interval(level)

    def distribution(self, what: str) -> Distribution:
        """All that the readings leave possible of it, of every frame; as `interval`."""
        return Distribution(self._solved(), what)

    @cached_property
    def patches(self) -> tuple[tuple[ContactPatch, ...], ...]:
        """Of every frame each contact by itself, the strongest first, numbered over the frames. ValueError without
        `has_bands`."""
        if self._known is None:
            raise ValueError(f"{self.method} knows no deviation of its answers: tikhonov and closed_form do")
        return followed_patches(self._known[4])

    @property
    def peak(self) -> int:
        """The frame that presses hardest, of those with the verdict ok if there is one."""
        force = np.where(self.verdict == "ok", self.normal_force, -np.inf)
        return int(np.nanargmax(force if np.isfinite(force).any() else np.nan_to_num(self.normal_force)))

    def to_json(self, name: str = "readings") -> str:
        """As `tactile-net solve --json` writes it."""
        return self._solved().json(name)

    def report(self, folder: str | PathLike[str], *, force: bool = False, name: str = "readings") -> str:
        """Writes the page that `tactile-net solve --out` writes, and returns the path of report.html.

        Raises OSError where a report.html stands that tactile-net has not written, unless `force`.
        """
        self._solved().report(fspath(folder), force, name)
        return f"{fspath(folder)}/report.html"

    def to_xarray(self) -> Any:
        """The recording's Dataset with `tractions` and, where the method knows it, `deviation` over (t, component, y);
        `verdict`, `data` and `alpha` over t. Where a component was not solved for it is nan."""
        from ._exchange import dataset_of

        return dataset_of(self._layout(), self.scene)

    @classmethod
    def from_xarray(cls, dataset: Any) -> Solution:
        """The solution of a Dataset as `to_xarray` makes it, without solving again. Raises InputError where it is of a
        recording."""
        from ._exchange import layout_in
        from ._judge import as_it_says, judged
        from ._layout import solution_in

        layout = layout_in(dataset)
        with as_it_says("dataset"):
            return solution_in(layout, judged(layout, "dataset", None, None, True), "dataset")

    def _layout(self, dtype: DTypeLike = np.float64) -> Layout:
        """With the deviation."""
        from ._layout import as_dtype, layout_of

        layout = layout_of(self, dtype)
        if self.has_bands and "deviation" not in layout.arrays:
            layout.arrays["deviation"] = as_dtype(dtype, "deviation", self.deviation)
        return layout

    def to_dataframe(self) -> Any:
        """A frame a row: forces, centre, their deviations, alpha, verdicts; over t."""
        pandas = optional("pandas", "tables")
        names = ["normal_force", "tangential_force", "centre"]
        if self.has_bands:
            names += [f"{name}_deviation" for name in names]
        columns: dict[str, Any] = {name: getattr(self, name) for name in names}
        columns |= {"alpha": self.alpha, "verdict": self.verdict, "data": self.data}
        return pandas.DataFrame(columns, index=None if self.t is None else pandas.Index(self.t, name="t"))

    def __len__(self) -> int:
        return len(self.tractions)

    def __repr__(self) -> str:
        ok = int((self.verdict == "ok").sum())
        return f"<Solution of {len(self)} frames by {self.method}, {ok} with the verdict ok>"

    def _repr_html_(self) -> str:
        html = _html.paragraphs([repr(self)[1:-1] + ".", *self.notes])
        if len(self) == 0:
            return html
        shown = self.tractions[self.peak]
        return (
            html
            + _html.paragraphs([f"Frame {self.peak}, which presses hardest:"])
            + _html.curves(self.y, list(zip(self.scene._components, shown)))
        )

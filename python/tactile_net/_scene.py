"""A scene: what the sensor is, what presses on it, how tractions are found again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Self

import numpy as np

from . import _core, _html
from ._arrays import Floats, frames_of
from ._check import ReadingsCheck
from ._circuit import Certification, Relaxation, Survey
from ._controller import Plan
from ._paths import replaced
from ._progress import Progress, listening
from ._recording import Recording, Solution
from ._result import Result
from ._solver import AnySolver, Solver
from ._tables import Contact, Material, Noise, Reconstruct, Sensor, Timing, as_table
from ._toml import text_of
from .errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Scene", "Sites"]


class Sites(NamedTuple):
    """Where and what each reading is of, in the order of the readings."""

    y: Floats
    depth: Floats
    quantity: NDArray[np.str_]
    taxel: NDArray[np.int_]
    channel: NDArray[np.int_]
    z: Floats
    """Across the surface [m]; of line arrays 0."""


class Scene:
    """One experiment as docs/scene.md describes it: a TOML text, judged by the library's reader.

    scene = tn.Scene(
        sensor=tn.Sensor(count=81, pitch=0.25e-3, depth=1.5e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        contacts=[tn.Cylinder(force=1.0, half_width=2e-3)],
    )

    Tables are dataclasses or dictionaries; any other table of a scene goes by its name, as in `crosstalk={...}`.
    It never changes, compares and hashes by its text, and is pickled as it. Threads may share one; they then wait for
    one another, so for speed give each its own.
    """

    _core: _core.Scene

    def __new__(
        cls,
        *,
        sensor: Sensor | Mapping[str, Any],
        material: Material | Mapping[str, Any],
        contacts: Iterable[Contact] = (),
        time: Timing | Mapping[str, Any] | None = None,
        noise: Noise | Mapping[str, Any] | None = None,
        reconstruct: Reconstruct | Mapping[str, Any] | None = None,
        title: str | None = None,
        file: str = "scene",
        **tables: Mapping[str, Any] | None,
    ) -> Self:
        named: dict[str, Any] = {
            "title": title,
            "sensor": sensor,
            "material": material,
            "contact": list(contacts) or None,
        }
        named |= {"time": time, "noise": noise, "reconstruct": reconstruct} | tables
        return cls.parse(text_of(as_table(named)), file=file)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Raises InputError with everything that is wrong with the file; OSError where there is none."""
        with open(path, "rb") as file:
            return cls.parse(file.read(), file=fspath(path))

    @classmethod
    def parse(cls, text: str | bytes, *, file: str = "scene") -> Self:
        """From TOML. file: its name in messages; what the scene refers to is beside it. Raises InputError."""
        core: Any = _read(text, file)
        kind: Any = _KINDS[type(core)]
        if not issubclass(kind, cls):
            raise InputError(f"{file}: error: is of a line array and of no skin: tactile_net.Scene takes both")
        scene: Self = object.__new__(kind)
        scene._core = core
        return scene

    @classmethod
    def from_dict(cls, table: Mapping[str, Any], *, file: str = "scene") -> Self:
        """From the tables of the file, as `to_dict` gives them. Raises InputError; TypeError for what TOML cannot hold."""
        return cls.parse(text_of(as_table(table)), file=file)

    def to_dict(self) -> dict[str, Any]:
        """The tables of the file, without its comments."""
        import tomllib  # here, for the time it takes

        return tomllib.loads(self.text.removeprefix("\ufeff"))

    def replace(self, changes: Mapping[str, Any]) -> Self:
        """A new scene with other values, by their dotted paths: `{"sensor.depth": 2e-3, "contact.0.force": 2.0}`.

        None takes a key out. Raises InputError, and KeyError where there is no such contact.
        """
        return type(self).from_dict(replaced(self.to_dict(), changes), file=self.file)

    # What it says.

    @property
    def text(self) -> str:
        """The TOML."""
        return self._core.text

    @property
    def file(self) -> str:
        return self._core.file

    @property
    def title(self) -> str:
        return self._core.title

    @property
    def count(self) -> int:
        """Taxels along y."""
        return self._core.count

    @property
    def even(self) -> bool:
        """Taxels are equally far apart, equally deep, and all read the same."""
        return self._core.even

    @property
    def channels(self) -> tuple[str, ...]:
        """A quantity each, of even arrays at each depth: "stress_x", "stress_x@1"."""
        return tuple(self._core.channels)

    @property
    def reading_names(self) -> tuple[str, ...]:
        """Of each reading, as the columns of a recording: "stress_x_0"."""
        return tuple(self._core.reading_names)

    @property
    def reading_shape(self) -> tuple[int, ...]:
        """Of a frame: (C, N), channels and taxels; of uneven arrays (R,)."""
        return (len(self._core.channels), self._core.count) if self.even else (self._core.readings,)

    @property
    def traction_shape(self) -> tuple[int, ...]:
        """Of one component: (M,), the places on the surface."""
        return (len(self.y),)

    _components: tuple[str, ...] = ("normal", "tangential")

    @property
    def _drags(self) -> bool:
        """Whether any contact drags: truths hold more than p."""
        return self._core.drags

    @property
    def _dims(self) -> tuple[tuple[str, ...], dict[str, Any]]:
        """Of a frame as an xarray.DataArray: its dimensions, and their coordinates."""
        if self.even:
            return ("channel", "taxel"), {"channel": list(self.channels), "taxel": self.taxels}
        return ("reading",), {"reading": list(self.reading_names)}

    @property
    def _surface(self) -> tuple[tuple[str, ...], dict[str, Any]]:
        """The same of tractions."""
        return ("y",), {"y": self.y}

    @property
    def _places(self) -> dict[str, Floats]:
        """Of the taxels, of uneven arrays of each reading, as files hold them."""
        return {"y": self.taxels if self.even else self.sites.y}

    def _rows(self, readings: Any, what: str = "readings") -> tuple[Floats, tuple[int, ...]]:
        """(..., *reading_shape) or (..., R) as (n, R), a frame a row in the library's order, and the shape that leads."""
        return frames_of(readings, self.reading_shape, what)

    def _ordered(self, frames: NDArray[Any]) -> NDArray[Any]:
        """(T, *reading_shape) as (T, R) in the order of `reading_names`, of whatever type they are."""
        return frames.reshape(len(frames), len(self.reading_names))

    def _framed(self, rows: Floats, lead: tuple[int, ...] = (-1,)) -> Floats:
        """(n, R) as (*lead, *reading_shape)."""
        return rows.reshape(*lead, *self.reading_shape)

    @property
    def unknowns(self) -> int:
        """1: normal tractions are solved for; more: tangential ones too, of line arrays one, of skins two."""
        return self._core.unknowns

    @property
    def methods(self) -> tuple[str, ...]:
        """That `run` compares."""
        return tuple(self._core.methods)

    @property
    def timing(self) -> tuple[float, int] | None:
        """Frames per second, and how many; None: one frame, of loads that have always been there."""
        return self._core.timing

    @cached_property
    def y(self) -> Floats:
        """(M,): where tractions lie on the surface [m]."""
        return _read_only(self._core.y())

    @property
    def spacing(self) -> float:
        """Of `y` [m]: forces are spacing x sum of tractions."""
        return self._core.spacing

    @cached_property
    def taxels(self) -> Floats:
        """(N,): y of the taxels [m]."""
        return _read_only(self._core.taxels())

    @cached_property
    def sites(self) -> Sites:
        """Where and what each reading is of."""
        y, depth, quantity, taxel, channel = self._core.sites()
        return Sites(y, depth, np.array(quantity), np.array(taxel), np.array(channel), np.zeros_like(y))

    def explain(self) -> str:
        """Which effects are simulated, what is computed and why, and what it takes: `tactile-net run --explain`."""
        return self._core.explain()

    def kernel_matrix(self) -> Floats:
        """K: readings are K f, for tractions f of the surface, normal ones first. (R, U*M)

        Neither weighted by the noise nor without dead taxels.
        """
        return self._core.kernel_matrix()

    def normal_matrix(self, alpha: float) -> Floats:
        """P = (WK)'(WK) + alpha (l^2/D^2 Q + I): the matrix of the circuit. (U*M, U*M)"""
        return self._core.normal_matrix(alpha)

    # What it does.

    def simulate(self, *, progress: Progress = False) -> Recording:
        """What the sensor would read, every frame of it, and the tractions that pressed."""
        with listening(progress) as heard:
            t, readings, truth, notes = self._core.simulate(heard)
        pressed = truth.reshape(len(t), -1, *self.traction_shape)
        if not self._drags:
            pressed = np.ascontiguousarray(pressed[:, :1])
        return Recording(self, self._framed(readings), t, pressed, tuple(notes))

    def read(self, path: str | PathLike[str], *, columns: str = "", missing: bool = True) -> Recording:
        """A file of frames, CSV or .npy, with the scene's units and calibration applied: readings in SI.

        columns: where the readings stand, where that is not found by name: "2-42", "t=1,4-44".
        missing: values that are missing are nan; else they are refused. Raises InputError.
        """
        t, readings, notes = self._core.read(fspath(path), columns, missing)
        return Recording(self, self._framed(readings), t, None, tuple(notes))

    def _recorded(self, recording: Any) -> Recording:
        """A Recording of this scene, of another one of the same shape, or an array of readings."""
        if not isinstance(recording, Recording):
            return Recording(self, self._framed(self._rows(recording)[0]))
        if recording.scene != self:
            return Recording(self, self._framed(self._rows(recording.readings)[0]), recording.t)
        return recording

    def _made_solver(self, method: str, alpha: float | None) -> AnySolver:
        return _core.Solver(self._core, method, alpha)

    def solver(self, method: str = "tikhonov", *, alpha: float | None = None) -> Solver:
        """A method made ready, of one alpha: "tikhonov", "closed_form" or "dft". alpha: in place of the scene's.

        Raises ValueError where the method cannot take the scene, UnsolvableError where its answer would be noise.
        """
        return Solver(self, method, alpha)

    def solve(
        self,
        recording: Any,
        method: str = "tikhonov",
        *,
        missing: Literal["fail", "skip", "estimate"] = "fail",
        share_alpha: int | None = None,
        progress: Progress = False,
    ) -> Solution:
        """Every frame of a Recording, or of an array of readings, with verdicts and bands.

        missing: what becomes of frames with nan. "estimate": solved from the taxels that are there.
        share_alpha: how many frames that follow one another choose alpha together.
        """
        return Solution(self._recorded(recording), method, missing, share_alpha, progress)

    def check(self, recording: Any, *, name: str = "readings", progress: Progress = False) -> ReadingsCheck:
        """What looks wrong with a Recording, or an array of readings, before it is solved: `tactile-net check`.

        Units, sign, broken taxels, offset, drift, noise, times. nan: missing. name: of the recording in the document.
        """
        return ReadingsCheck(self._recorded(recording), name, progress)

    def run(
        self,
        *,
        frame: int | None = None,
        compare_rules: bool = False,
        realization: str | None = None,
        progress: Progress = False,
    ) -> Result:
        """As `tactile_net.run`."""
        scene = self._realized(realization)
        if realization is not None and "network" not in self.methods:
            scene = scene.replace({"reconstruct.methods": [*self.methods, "network"]})
        return Result(scene, frame, compare_rules, progress)

    def identify(
        self, *, traction: float | None = None, noise: float | None = None, progress: Progress = False
    ) -> Survey:
        """What these sensors can tell, and which others could.

        traction: amplitude of the ripples to be told [Pa]; None: the contacts' peak.
        noise: over the largest reading of such a ripple; None: the scene's.
        """
        return Survey(self, traction, noise, progress)

    def plan(
        self,
        *,
        accuracy: float = 1e-7,
        readings: Any = None,
        structure: str | None = None,
        precision: Literal["float64", "float32"] | None = None,
        diagnostics: bool = True,
        allow_fft: bool = False,
        friction: float | None = None,
        friction_limit: float | None = None,
        nonnegative: bool = False,
        steps: int | None = None,
        progress: Progress = False,
    ) -> Plan:
        """The plan of a controller: the cheapest product that is proven to be accurate enough. It is linear, and the scene's
        constraints do not bind it, unless one of these is given:

        friction_limit: frames obey |q| <= friction_limit p in every cell; nonnegative: p >= 0 alone. They take a fixed number of
        steps towards that (steps: 1 to 64; None: as few as leave a tenth of a standard deviation), and `contact.unfinished` says
        of each frame how far it is from the minimum at most.

        readings: recorded frames to choose alpha on, where the scene has a rule; None: its own contacts.
        structure, precision: None: the cheapest; "fft", and allow_fft, are of line arrays. diagnostics: residual, outliers, dead taxels at run time.
        friction: of pad and object, for the friction margin; None: the scene's limit.
        """
        rows = None if readings is None else self._rows(getattr(readings, "readings", readings))[0]
        with listening(progress) as heard:
            chosen = structure, precision, diagnostics, allow_fft, friction
            core = _core.plan(self._core, accuracy, rows, *chosen, friction_limit, nonnegative, steps or 0, heard)
        return Plan(core)

    def certify(self, realization: str | None = None, *, progress: Progress = False) -> Certification:
        """Whether the scene's circuit settles, how fast, and what errors of its parts it bears."""
        return Certification(self._realized(realization), progress)

    def relax(self, realization: str | None = None, *, progress: Progress = False) -> Relaxation:
        """Runs the scene's circuit in ngspice, which must be installed. Raises SimulatorError."""
        return Relaxation(self._realized(realization), progress)

    def netlist(self, realization: str | None = None) -> str:
        """The circuit as a deck for `ngspice -b`: "ideal", "nic", "least_squares", ...; None: the scene's."""
        return _core.netlist(self._realized(realization)._core)

    def raw_numbers(self, readings: Any) -> Floats:
        """Readings as a file of this scene has them: in its units, before its calibration. As their shape."""
        rows, lead = self._rows(readings)
        return self._framed(self._core.raw_numbers(rows), lead)

    def _realized(self, realization: str | None) -> Self:
        return self if realization is None else self.replace({"network.realization": realization})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and (self.text, self.file) == (other.text, other.file)

    def __hash__(self) -> int:
        return hash((self.text, self.file))

    def __reduce__(self) -> tuple[Any, ...]:
        return _parsed, (self.text, self.file)

    def __repr__(self) -> str:
        return f"Scene.parse({self.text!r}, file={self.file!r})"

    def __str__(self) -> str:
        return "\n".join(filter(None, (self.title, *self._core.words())))

    def _repr_html_(self) -> str:
        effects = [("effect", "simulated", "what it does")]
        effects += [(name, "yes" if present else "no", words) for name, present, words in self._core.effects()]
        return _html.paragraphs(str(self).splitlines()) + _html.table([row for row in effects if row[1] != "no"])


_KINDS: dict[type, type[Scene]] = {_core.Scene: Scene}
"""Which class the library's scenes are; skins enter theirs."""


def _parsed(text: str, file: str) -> Scene:
    return Scene.parse(text, file=file)


def _read(text: str | bytes, file: str) -> _core.Scene | _core.Skin:
    if isinstance(text, str):
        try:
            text = text.encode()
        except UnicodeEncodeError as error:  # half a character: no file can hold it
            raise InputError(f"{file}: error: is not Unicode: {error}") from None
    try:
        return _core.parse(text.decode(), file)
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: error: is not UTF-8: {error}") from None


def _read_only(values: Floats) -> Floats:
    values.flags.writeable = False
    return values

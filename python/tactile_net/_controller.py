"""A controller's plan, and the call of its every frame."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Any

from . import _core, _html
from ._arrays import Floats, frames_of, lattice_frames_of

if TYPE_CHECKING:
    from ._scene import Scene

__all__ = ["ContactEstimate", "ContactRow", "Estimator", "Plan"]

ContactEstimate = _core.ContactEstimate
ContactRow = _core.ContactRow


class Plan:
    """All that a controller needs to turn a frame of readings into tractions. Made by `Scene.plan`, or loaded."""

    def __init__(self, core: _core.Plan) -> None:
        self._core = core

    @classmethod
    def load(cls, path: str | PathLike[str], *, scene: Scene | None = None) -> Plan:
        """scene: of a skin, that it was planned for; without it frames may have to be flat, see `reading_shape`.

        Raises OSError, and ValueError where the file is no plan, cut off, corrupted, of another version or another scene.
        """
        with open(path, "rb") as file:
            content = file.read()
        try:
            return cls.from_bytes(content, scene=scene)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None

    @classmethod
    def from_bytes(cls, content: bytes, *, scene: Scene | None = None) -> Plan:
        """Any bytes at all are safe to pass. Raises ValueError, as `load`."""
        plan = cls(_core.plan_from(bytes(content), "", False, False, *_lattice_of(scene)))
        if scene is not None and (plan._core.readings, plan.traction_shape[1:]) != (
            len(scene.reading_names),
            scene.traction_shape,
        ):
            raise ValueError(
                f"the plan is of {plan._core.readings} readings and tractions {plan.traction_shape[1:]}, "
                f"the scene of {len(scene.reading_names)} and {scene.traction_shape}"
            )
        return plan

    def to_bytes(self) -> bytes:
        return self._core.to_bytes()

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the file that `tactile-net plan -o` writes; a C++ controller loads it too."""
        with open(path, "wb") as file:
            file.write(self.to_bytes())

    def __reduce__(self) -> tuple[Any, ...]:
        said = self.why, self.for_raw_numbers, self.needs_baseline
        return _plan, (self.to_bytes(), *said, self._core.rows, self._core.columns)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Plan) and self.to_bytes() == other.to_bytes()

    def __hash__(self) -> int:
        return hash(self.to_bytes())

    @property
    def label(self) -> str:
        """What it was made for."""
        return self._core.label

    @property
    def reading_shape(self) -> tuple[int, ...]:
        """Of a frame: (C, N), channels and taxels; of skins (rows, columns, C); of uneven arrays (R,).

        Of a skin's plan that was loaded without its scene and does not use the skin's symmetry (R,) too: the file does not
        say how the taxels lie. Flat frames are in the order of `reading_names`, channel after channel.
        """
        core = self._core
        if core.rows > 0:
            return core.rows, core.columns, core.channels
        return (core.channels, core.count) if core.even and not core.is_skin else (core.readings,)

    def _rows(self, frames: Any) -> tuple[Floats, tuple[int, ...]]:
        return (lattice_frames_of if self._core.rows > 0 else frames_of)(frames, self.reading_shape, "frames")

    @property
    def traction_shape(self) -> tuple[int, ...]:
        """(U, M), of skins (U, rows, columns): normal, then tangential, at `y` and `z`."""
        return self._core.unknowns, *filter(None, (len(self.y), len(self.z)))

    @property
    def y(self) -> Floats:
        """Of the tractions, of skins of their rows [m]."""
        return self._core.y()

    @property
    def z(self) -> Floats:
        """Of a skin's columns of tractions [m]; of line arrays empty."""
        return self._core.z()

    @property
    def spacing(self) -> float:
        """Of `y` [m]."""
        return self._core.spacings[0]

    @property
    def spacing_z(self) -> float:
        """Of a skin's `z` [m]."""
        return self._core.spacings[1]

    @property
    def alpha(self) -> float:
        return self._core.alpha

    @property
    def accuracy(self) -> float:
        """That was asked for."""
        return self._core.accuracy

    @property
    def error_bound(self) -> float:
        """Proven for every frame: relative to the tractions and to what they leave unexplained."""
        return self._core.error_bound

    @property
    def structure(self) -> str:
        """How the product is computed: "dense", "low_rank"; by the array's mirror symmetry "reflections" or
        "reflections_low_rank"; of lines "fft" too."""
        return self._core.structure

    @property
    def precision(self) -> str:
        return self._core.precision

    @property
    def streamed_bytes(self) -> int:
        """That a frame reads: what its time is made of."""
        return self._core.streamed_bytes

    @property
    def diagnostics(self) -> bool:
        """Whether frames come with residual, outliers and doubts, and taxels may die at run time."""
        return self._core.diagnostics

    @property
    def friction_limit(self) -> float | None:
        """That frames obey in every cell; None: they obey none."""
        return self._core.friction_limit

    @property
    def steps(self) -> int:
        """Of a frame towards its constraints; 0: it has none, the plan is linear."""
        return self._core.steps

    @property
    def unfinished(self) -> tuple[float, float, float]:
        """Of a plan with constraints, what its steps leave of frames that were drawn: the median, 99.9 % and the worst, in
        standard deviations where the plan knows the noise, else as shares of the linear frame."""
        return self._core.unfinished

    @property
    def for_raw_numbers(self) -> bool:
        """The scene's calibration is in it: frames are a file's numbers, not readings."""
        return self._core.for_raw_numbers

    @property
    def needs_baseline(self) -> bool:
        """`Estimator.set_baseline` is to be called with an unloaded frame before the first update."""
        return self._core.needs_baseline

    @property
    def why(self) -> str:
        """What was chosen, and against what; empty where the plan was loaded."""
        return self._core.why

    def __repr__(self) -> str:
        readings, tractions = (" x ".join(map(str, shape)) for shape in (self.reading_shape, self.traction_shape))
        kind = f"{self.structure} {self.precision}"
        return f"<Plan {kind}: {readings} readings -> {tractions} tractions, alpha {self.alpha:g}>"

    def _repr_html_(self) -> str:
        return _html.preformatted(f"{self!r}\n{self.why}")


def _plan(
    content: bytes, why: str, for_raw_numbers: bool, needs_baseline: bool, rows: int = 0, columns: int = 0
) -> Plan:
    return Plan(_core.plan_from(content, why, for_raw_numbers, needs_baseline, rows, columns))


def _lattice_of(scene: Scene | None) -> tuple[int, int]:
    """Rows and columns of an even skin's taxels; else 0."""
    shape = () if scene is None else scene.reading_shape
    return (shape[0], shape[1]) if len(shape) == 3 else (0, 0)


class Estimator(_core.Estimator):
    """The per-frame call of a controller: readings in, tractions and the contact's force out.

    `update` takes and fills C-contiguous float64 arrays as they are, of skins (rows, columns, C), or flat, channel after
    channel; `step` works on the estimator's own `readings` and `tractions`, at the least price. One thread at a time: another one is refused with a RuntimeError.
    """

    def __init__(self, plan: Plan, *, contacts: int = 0) -> None:
        """contacts: how many of a frame's contacts `contacts` tells one by one, at most 16."""
        super().__init__(plan._core, contacts)
        self._made_of = plan

    @property
    def plan(self) -> Plan:  # type: ignore[override]
        return self._made_of

    def update_batch(self, frames: Any) -> Floats:
        """As `update` on each of (T, C, N) or (T, C*N) frames, and the same bits; returns (T, U, M). Of skins frames
        (T, rows, columns, C) or (T, R), and tractions (T, U, rows, columns).

        Other Python threads go on meanwhile. `contact` is then that of the last frame. Raises FrameError, which
        names the first frame that is bad.
        """
        rows, lead = self._made_of._rows(frames)
        return super().update_batch(rows).reshape(*lead, *self._made_of.traction_shape)

    def __reduce__(self) -> tuple[Any, ...]:
        return _estimator, (self._made_of, self.baseline, self.dead, self.work, self.most_contacts)

    def __copy__(self) -> Estimator:
        """For another thread: the same plan, baseline, dead taxels and work."""
        return _estimator(self._made_of, self.baseline, self.dead, self.work, self.most_contacts)

    def __deepcopy__(self, memo: dict[int, Any]) -> Estimator:
        return self.__copy__()


def _estimator(
    plan: Plan, baseline: Floats | None, dead: tuple[int, ...], work: tuple[int, float] = (0, 0.0), contacts: int = 0
) -> Estimator:
    estimator = Estimator(plan, contacts=contacts)
    if plan.steps > 0:
        estimator.set_work(*work)
    for taxel in dead:  # first: what they read does not matter then
        estimator.set_dead(taxel)
    if baseline is not None:
        estimator.set_baseline(baseline)
    return estimator

"""What a skin's recording was solved to."""

from __future__ import annotations

from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from . import _core, _html
from ._arrays import Floats
from ._told import ContactPatch, followed_patches
from ._optional import optional
from ._recording import Recording, Solution

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._skin import Skin, Surface
    from .sensors import PointSet, SensorRecording

__all__ = ["COMPONENTS", "SkinSolution"]

COMPONENTS = ("normal", "tangential_y", "tangential_z")
RESULTANT = ("normal", "tangential_y", "tangential_z", "centre_y", "centre_z", "torsion", "friction")
SPACE = tuple(f"{what}_{axis}" for what in ("force", "moment", "centre") for axis in "xyz")
EARLIER = "covariance"
"""What the library, and files of earlier versions, call `wrench_covariance`; there values and deviations stand side by side."""


class SkinSolution(Solution):
    """Three tractions of every frame, what they amount to, and how far to trust them. Made by `Skin.solve`.

    Forces, centre and torsion are sums over the cells that touch (`touching`), or over all where none is certain to, each
    with its deviation.
    """

    touching: NDArray[np.bool_]
    """(T, rows, columns): the cells that a contact covers."""
    contacts: NDArray[np.int_]
    """(T,): how many contacts lie apart."""
    sensor: SensorRecording | None = None
    """The recording of a sensor that was solved; None: it was of a scene."""

    def _know(self, core: _core.SolvedRecording) -> None:
        self._take(core.fields(list(RESULTANT)))

    def _take(self, found: Any) -> None:
        frames, places = len(self.recording), self.scene.traction_shape
        components = found["tractions"][:1].size // (places[0] * places[1]) or self.scene.unknowns
        self.tractions = found["tractions"].reshape(frames, components, *places)
        self._deviation = found["deviation"].reshape(frames, components, *places)
        self.touching = found["touching"].reshape(frames, *places) != 0.0
        self._wrench = found["wrench"]  # seven values, each with its deviation behind it
        self.wrench_covariance = found[EARLIER].reshape(frames, 6, 6)
        """(T, 6, 6): of the first six numbers of `wrench`; 0 where one is not known."""
        self._space = found.get("space")  # nine values, each with its deviation behind it
        self._ellipse = found["ellipse"]
        self.verdict = np.array(found["verdict"], dtype=np.str_)
        self.data = np.array(found["data"], dtype=np.str_)
        self.alpha = found["alpha"]
        self.contacts = np.asarray(found["contacts"]).astype(np.int_)

    def _held(self) -> dict[str, Floats]:
        return super()._held() | {
            "deviation": self._deviation,
            "wrench": self.wrench,
            "wrench_deviation": self.wrench_deviation,
            "wrench_covariance": self.wrench_covariance,
            "ellipse": self.ellipse,
            "ellipse_deviation": self.ellipse_deviation,
            "touching": self.touching,
            "contacts": self.contacts,
        } | ({} if self._space is None else {"space": self._space[:, 0::2], "space_deviation": self._space[:, 1::2]})

    @classmethod
    def _restored(cls, held: dict[str, Floats], **state: Any) -> SkinSolution:
        solution = cls.__new__(cls)
        solution.__dict__.update(state, _core=None)
        known = held if EARLIER in held else _side_by_side(held)  # else a file of an earlier version
        solution._take(known | {"verdict": state["verdict"], "data": state["data"]})
        return solution

    @property
    def scene(self) -> Skin:
        return cast("Skin", self.recording.scene)

    @property
    def z(self) -> Floats:
        """(columns,): of the cells' middles [m]."""
        return self.scene.z

    @property
    def normal(self) -> Floats:
        """(T, rows, columns): p [Pa]."""
        return np.asarray(self.tractions[:, 0])

    @property
    def tangential(self) -> Floats:
        """(T, 2, rows, columns): q_y and q_z [Pa]; (T, 0, rows, columns) where only p was solved for."""
        return np.asarray(self.tractions[:, 1:])

    @property
    def has_bands(self) -> bool:
        return True

    @property
    def deviation(self) -> Floats:
        """(T, U, rows, columns): one standard deviation of each traction [Pa]."""
        return np.asarray(self._deviation)

    @property
    def wrench(self) -> Floats:
        """(T, 7): normal force, forces along y and z [N], y and z of the centre of pressure [m], torsion about it [N m],
        and the drag over the normal force; nan where one is not known."""
        return np.asarray(self._wrench[:, 0:14:2])

    @property
    def wrench_deviation(self) -> Floats:
        """(T, 7): one standard deviation of each."""
        return np.asarray(self._wrench[:, 1:14:2])

    @property
    def normal_force(self) -> Floats:
        """(T,) [N]"""
        return np.asarray(self.wrench[:, 0])

    @property
    def normal_force_deviation(self) -> Floats:
        """(T,): one standard deviation [N]"""
        return np.asarray(self.wrench_deviation[:, 0])

    @property
    def tangential_force(self) -> Floats:
        """(T, 2): along y and z [N]; nan where only p was solved for."""
        return np.asarray(self.wrench[:, 1:3])

    @property
    def tangential_force_deviation(self) -> Floats:
        return np.asarray(self.wrench_deviation[:, 1:3])

    @property
    def centre(self) -> Floats:
        """(T, 2): y and z where the normal force acts [m]; nan where nothing presses. Of a curved skin (T, 3): the mean of
        the places that press, in the sensor's axes, which lies below a convex surface."""
        return np.asarray(self.wrench[:, 3:5]) if self._space is None else self._in_space(2)

    @property
    def centre_deviation(self) -> Floats:
        return np.asarray(self.wrench_deviation[:, 3:5]) if self._space is None else self._in_space(2, 1)

    def _in_space(self, which: int, deviation: int = 0) -> Floats:
        if self._space is None:
            raise ValueError("forces in the sensor's axes are of a curved skin, and this one is flat: see `wrench`")
        return np.asarray(self._space[:, 6 * which + deviation : 6 * which + 6 : 2])

    @property
    def force(self) -> Floats:
        """(T, 3): of a curved skin the force that acts on it, along the sensor's axes [N]. ValueError of a flat one."""
        return self._in_space(0)

    @property
    def force_deviation(self) -> Floats:
        """(T, 3): one standard deviation [N]"""
        return self._in_space(0, 1)

    @property
    def moment(self) -> Floats:
        """(T, 3): of a curved skin the moment of that force about `moment_about`, the origin if that is left out [N m]."""
        return self._in_space(1)

    @property
    def moment_deviation(self) -> Floats:
        """(T, 3): one standard deviation [N m]"""
        return self._in_space(1, 1)

    @property
    def pressed(self) -> Floats:
        """(T,): what presses along each place's own normal, summed [N]: `normal_force` by the name that curved skins have."""
        return self.normal_force

    @property
    def pressed_deviation(self) -> Floats:
        """(T,): one standard deviation [N]"""
        return self.normal_force_deviation

    @property
    def surface(self) -> Surface | None:
        """The cells of a curved skin; None: it is flat."""
        return self.scene.surface

    @property
    def torsion(self) -> Floats:
        """(T,): moment about the surface's normal through the centre of pressure, from y towards z [N m]."""
        return np.asarray(self.wrench[:, 5])

    @property
    def torsion_deviation(self) -> Floats:
        return np.asarray(self.wrench_deviation[:, 5])

    @property
    def friction(self) -> Floats:
        """(T,): drag over normal force."""
        return np.asarray(self.wrench[:, 6])

    @property
    def friction_deviation(self) -> Floats:
        return np.asarray(self.wrench_deviation[:, 6])

    @cached_property
    def patches(self) -> tuple[tuple[ContactPatch, ...], ...]:
        """Of every frame each contact by itself, the strongest first, numbered over the frames."""
        return followed_patches(self._solved().patches())

    @property
    def ellipse(self) -> Floats:
        """(T, 3): radii of the strongest contact by Hertz' law [m], and the longer one's angle from y towards z [rad]."""
        return np.asarray(self._ellipse[:, 0::2])

    @property
    def ellipse_deviation(self) -> Floats:
        return np.asarray(self._ellipse[:, 1::2])

    def to_point_set(self, layout: str = "lerobot") -> PointSet:
        """A force at each taxel along the sensor's axes, with its deviation: (T, N, 6) of dx, dy, dz, Fx, Fy, Fz [m, N]; of
        layout "isaac" (T, N, 3) of Fx, Fy, Fz. Each taxel has the force of the cells nearest to it, so that their sum is the
        resultant; displacements are nan where none are read. ValueError where no sensor's recording was solved.
        """
        from .sensors._point_set import point_set

        if self.sensor is None:
            raise ValueError("point sets are of a sensor's recording: tn.load(path, sensor=...).solve()")
        return point_set(self, self.sensor, layout)

    def report(self, folder: str | PathLike[str], *, force: bool = False, name: str = "readings") -> str:
        """Writes the page that `tactile-net solve --out` writes, and returns the path of report.html.

        Raises OSError where a report.html stands that tactile-net has not written, unless `force`; ValueError where
        there is no frame.
        """
        if len(self) == 0:
            raise ValueError("the recording holds no frame")
        return super().report(folder, force=force, name=name)

    def to_xarray(self) -> Any:
        """The recording's Dataset with `tractions` and `deviation` over (t, component, y, z), `touching`, `wrench`,
        `wrench_deviation`, `wrench_covariance`, `ellipse`, `ellipse_deviation`, `contacts`, `verdict`, `data` and `alpha`."""
        return super().to_xarray()

    def to_dataframe(self) -> Any:
        """A frame a row, as `solve --uncertainty` writes it: forces, centre, torsion, friction, angle and slip margin,
        their deviations, offsets where they were sought, alpha, verdict; over t."""
        pandas = optional("pandas", "tables")
        names, values = self._solved().uncertainty()
        columns: dict[str, Any] = {name: values[:, i] for i, name in enumerate(names)}
        columns |= {"contacts": self.contacts, "alpha": self.alpha, "verdict": self.verdict}
        return pandas.DataFrame(columns, index=None if self.t is None else pandas.Index(self.t, name="t"))

    @cached_property
    def _page(self) -> str:
        return self._solved().html("readings")

    def _repr_html_(self) -> str:
        if len(self) == 0:
            return _html.paragraphs([repr(self)[1:-1] + "."])
        return _html.page(self._page)


def _side_by_side(held: dict[str, Floats]) -> dict[str, Floats]:
    """With each value beside its deviation, as the library gives them."""
    together = {
        name: np.stack([held[name], held[f"{name}_deviation"]], axis=-1).reshape(len(held[name]), -1)
        for name in ("wrench", "ellipse", "space")
        if name in held
    }
    return held | together | {EARLIER: held["wrench_covariance"]}

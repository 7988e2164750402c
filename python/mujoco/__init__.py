"""Taxels in MuJoCo: a scene's sensor under the flat face of a body.

    pad = tn.mujoco.Pad(model, site="pad", scene=tn.Scene.load("pad.toml"), breadth=20e-3)
    mujoco.mj_step(model, data)
    readings = pad.read(data)                # (C, N)

MuJoCo's contacts are one to a few points with a force each; a soft pad spreads them. Each object that touches is one
patch of tractions: of a sphere, capsule or cylinder Hertz' strip, on a skin a ball's Hertz' circle; of all else the
linear traction over its contact points, on a skin over their hull, that has their force and moment. What the taxels read
of these goes through the scene's own effects.
"""

from __future__ import annotations

import atexit
import warnings
import weakref
from collections.abc import Callable, Iterable
from os import PathLike
from typing import Any

import numpy as np

from .. import _core
from .._arrays import Floats
from .._optional import optional
from .._scene import Scene
from .._skin import Skin

__all__ = ["Pad", "ShortContactWarning"]

_PULLED, _FLEX, _SHORT = 1, 2, 4


class ShortContactWarning(UserWarning):
    """A contact is so short across the array that plane strain tells its size, not its readings."""


class Pad:
    """The taxels below a site of a MuJoCo model: its z axis points out of the pad, its x axis along the array.

    Of a skin rows follow one another along the site's x axis, and columns along minus its y axis; readings are those of
    a half space or a layer, and are (rows, columns, C), in the model's user sensor too.

    Of a line array readings are those of plane strain, in which every contact reaches across the whole breadth of the pad. That holds
    for a cylinder, an edge, a box; of a ball that is smaller than the pad is wide the force is right and the
    height of the readings is not, of which a ShortContactWarning tells once.

    Each mjData has a sensor of its own, with memory and noise, which begins at rest where time does not go on: after a
    reset, in the next rollout, in a copy. So equal rollouts have equal readings, on any number of threads.
    """

    def __init__(
        self,
        model: Any,
        *,
        site: str,
        scene: Scene | str | PathLike[str],
        breadth: float | None = None,
        edge_width: float | None = None,
        geoms: Iterable[str] | None = None,
    ) -> None:
        """
        scene: sensor, material and effects; its contacts and [time] are not looked at. In SI, or in the model's units.
        breadth: of the pad, along the site's y axis [m], over which forces are spread; of skins left out.
        edge_width: the least width of a contact whose curvature nobody knows [m]; None: half the least depth.
        geoms: that are the pad's; None: all of the site's body.

        Raises ValueError where the model has no such site or geom, or a width is not > 0; InputError as `Scene.load`.
        """
        self._mujoco = mujoco = optional("mujoco", "mujoco")
        if not isinstance(model, mujoco.MjModel):
            raise TypeError(f"model must be a mujoco.MjModel, got {type(model).__name__}")
        self.model = model
        self.scene = scene if isinstance(scene, Scene) else Scene.load(scene)
        self.site = site
        self._site = _id_of(mujoco, model, mujoco.mjtObj.mjOBJ_SITE, "site", site)
        self._own = frozenset(self._geoms(geoms))
        kinds = mujoco.mjtGeom
        rounded = [int(kind) for kind in (kinds.mjGEOM_SPHERE, kinds.mjGEOM_CAPSULE, kinds.mjGEOM_CYLINDER)]
        radius = np.where(np.isin(model.geom_type, rounded), model.geom_size[:, 0], np.inf)
        own, curvature = [geom in self._own for geom in range(model.ngeom)], (1.0 / radius).tolist()
        edge = None if edge_width is None else float(edge_width)
        self._core: _core.RigidPad | _core.RigidSkinPad
        if isinstance(self.scene, Skin):
            if breadth is not None:
                raise ValueError("breadth is of line arrays, and this scene is of a skin: leave it out")
            self._core = _core.RigidSkinPad(self.scene._core, own, curvature, edge)
        elif breadth is None:
            raise ValueError(
                "breadth: forces on a line array are spread over the breadth of its pad, which must be given"
            )
        else:
            self._core = _core.RigidPad(self.scene._core, own, curvature, float(breadth), edge)
        self.breadth = None if breadth is None else float(breadth)
        self.edge_width = self._core.edge
        self._size = len(self.scene.reading_names)
        self._known: set[int] = set()
        self._told = 0
        self._address = -1

    def _geoms(self, names: Iterable[str] | None) -> list[int]:
        mujoco, model = self._mujoco, self.model
        if names is not None:
            return [_id_of(mujoco, model, mujoco.mjtObj.mjOBJ_GEOM, "geom", name) for name in names]
        body = model.site_bodyid[self._site]
        own = np.flatnonzero(model.geom_bodyid == body).tolist()
        if not own:
            raise ValueError(
                f"the body of the site {self.site!r} has no geom that could be touched: name some by geoms"
            )
        return [int(geom) for geom in own]

    def read(self, data: Any) -> Floats:
        """(C, N), of skins (rows, columns, C), of uneven arrays (R,): readings of the contacts, as they were when MuJoCo
        last computed forces.

        After mj_step they are those of the moment before it, mj_forward brings them up to date.
        """
        readings = np.empty(self._size)
        self._fill(self.model, data, readings, 0)
        return readings.reshape(self.scene.reading_shape)

    def _fill(self, model: Any, data: Any, readings: Floats, offset: int) -> None:
        contact = data.contact
        geoms = contact.geom
        own = self._own
        forces = np.zeros((len(geoms), 6))
        for i, (one, other) in enumerate(geoms.tolist()):
            if (one in own) is not (other in own):
                self._mujoco.mj_contactForce(model, data, i, forces[i])
        state = id(data)
        if state not in self._known:
            self._known.add(state)
            weakref.finalize(data, _forget, weakref.ref(self), state).atexit = False
        notes = self._core.read(
            state,
            data.time,
            geoms,
            contact.pos,
            contact.frame,
            forces,
            data.site_xpos[self._site],
            data.site_xmat[self._site],
            readings,
            offset,
        )
        if notes & ~self._told:
            self._tell(notes & ~self._told)

    def _tell(self, notes: int) -> None:
        self._told |= notes
        if notes & _PULLED:
            self._warn(
                f"a contact pulls at the pad {self.site!r}, and is left out: its site's z axis must point out of it"
            )
        if notes & _FLEX:
            self._warn(f"a flex touches the pad {self.site!r}, and is left out: only geoms are taken")
        if notes & _SHORT:
            self._warn(
                f"a contact on the pad {self.site!r} is shorter across the array than three depths of its taxels: its force"
                " is right, the height of its readings is that of one which reaches across the pad",
                ShortContactWarning,
            )

    def _warn(self, text: str, category: type[Warning] = UserWarning) -> None:
        warnings.warn(text, category, stacklevel=5)

    def install(self) -> None:
        """Fills the model's user sensor on this site at every step, so that logs and rollouts hold the readings.

        It takes MuJoCo's one callback for user sensors, mjcb_sensor; another that stands there is still called. Raises
        ValueError where the model has no sensor for it, with the line to add. While any callback of Python's stands,
        MuJoCo compiles no model with user sensors: make models first, or `uninstall`.
        """
        self._address = self._sensor()
        _install(self._mujoco, self)

    def uninstall(self) -> None:
        _uninstall(self._mujoco, self)

    def _sensor(self) -> int:
        mujoco, model = self._mujoco, self.model
        line = f'<user name="taxels" dim="{self._size}" needstage="acc" objtype="site" objname="{self.site}"/>'
        here = (model.sensor_objtype == int(mujoco.mjtObj.mjOBJ_SITE)) & (model.sensor_objid == self._site)
        found = np.flatnonzero(here & (model.sensor_type == int(mujoco.mjtSensor.mjSENS_USER)))
        if len(found) != 1:
            raise ValueError(f"the model has {len(found)} user sensors on the site {self.site!r}, not this one: {line}")
        (sensor,) = found
        if model.sensor_dim[sensor] != self._size:
            raise ValueError(
                f"the sensor on the site {self.site!r} has dim {model.sensor_dim[sensor]}, the scene has {self._size}"
                f" readings: {line}"
            )
        if model.sensor_needstage[sensor] != int(mujoco.mjtStage.mjSTAGE_ACC):
            raise ValueError(f'the sensor on the site {self.site!r} must have needstage="acc": forces come last')
        return int(model.sensor_adr[sensor])

    def _is_of(self, model: Any) -> bool:
        """Whether it is the pad's model, or a copy."""
        mine = self.model
        return model is mine or (model.nsensordata == mine.nsensordata and model.names == mine.names)

    def __repr__(self) -> str:
        return f"<Pad of {self._size} readings at the site {self.site!r}>"


def _id_of(mujoco: Any, model: Any, kind: Any, what: str, name: str) -> int:
    found = int(mujoco.mj_name2id(model, kind, name))
    if found < 0:
        count = getattr(model, f"n{what}")
        names = [mujoco.mj_id2name(model, kind, i) for i in range(count)]
        known = ", ".join(repr(one) for one in names if one)
        raise ValueError(f"the model has no {what} {name!r}" + (f": it has {known}" if known else ""))
    return found


def _forget(pad: weakref.ref[Pad], state: int) -> None:
    if (living := pad()) is not None:
        living._known.discard(state)
        living._core.forget(state)


_installed: list[Pad] = []
_before: Callable[[Any, Any, int], object] | None = None
_ACC = 3  # mjSTAGE_ACC


def _sense(model: Any, data: Any, stage: int) -> None:
    if _before is not None:
        _before(model, data, stage)
    if stage != _ACC:
        return
    for pad in _installed:
        if pad._is_of(model):
            pad._fill(model, data, data.sensordata, pad._address)


def _install(mujoco: Any, pad: Pad) -> None:
    global _before
    standing = mujoco.get_mjcb_sensor()
    if standing is not _sense:
        _before = standing
        mujoco.set_mjcb_sensor(_sense)
        atexit.register(_leave, mujoco)  # MuJoCo would keep the pads beyond the interpreter's end
    if pad not in _installed:
        _installed.append(pad)


def _uninstall(mujoco: Any, pad: Pad) -> None:
    if pad in _installed:
        _installed.remove(pad)
    if not _installed:
        _leave(mujoco)


def _leave(mujoco: Any) -> None:
    global _before
    _installed.clear()
    if mujoco.get_mjcb_sensor() is _sense:
        mujoco.set_mjcb_sensor(_before)
    _before = None
    atexit.unregister(_leave)

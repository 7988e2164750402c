"""SynTouch BioTac: 19 impedances of electrodes in a fluid, pressure and temperature of it. CSV: E1 ... E19, PDC, PAC, TDC, TAC."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._geometry import Frames, Geometry, numbers_of, read_table
from .._refusal import refused
from . import Given
from ._reading import header_of

name = "biotac"
refusal = _core.sensor_refusal(name)
_ELECTRODES = [f"e{k}" for k in range(1, 20)]
_OTHERS = ["pdc", "pac", "tdc", "tac"]
_MOST = 1 << 30


def _known(names: list[str]) -> dict[str, str]:
    """The file's names by ours."""
    return {one.lower().replace("electrode_", "e"): one for one in names}


def sniff(path: str) -> float:
    """All 19 electrodes' names."""
    return 0.9 if set(_ELECTRODES) <= set(_known(header_of(path))) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """None: electrodes are no taxels below a pad."""
    raise refused(path, f"has no geometry of taxels: {refusal}")


def frames(path: str, given: Given) -> Frames:
    """The electrodes' counts (T, 19, 1), and behind them what of PDC, PAC, TDC and TAC there is."""
    header, rows = read_table(path, _MOST)
    known = _known(header)
    missing = [one for one in _ELECTRODES if one not in known]
    if missing:
        raise refused(path, f"has no column of the electrodes {', '.join(missing)}", "E1 to E19")
    wanted = [*_ELECTRODES, *(one for one in _OTHERS if one in known)]
    columns = [numbers_of(path, known[one], [row[header.index(known[one])] for row in rows]) for one in wanted]
    times = next((known[one] for one in ("t", "time", "timestamp") if one in known), None)
    t = None if times is None else numbers_of(path, times, [row[header.index(times)] for row in rows])
    notes = (f"channels are {', '.join(wanted)}",)
    return Frames(np.stack(columns, axis=1)[..., np.newaxis], t, "count", "local", notes=notes, file=path)

"""XELA uSkin: messages of the maker's server, one JSON a line: under a sensor's number `data`, hexadecimal counts of x, y and z
of each taxel after taxel, and of calibrated ones `calibrated`, the same in newtons. Places are given: geometry=, or pitch= of the
rows and columns that model= says ("4x6")."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._geometry import QUANTITIES, Frames, Geometry
from .._refusal import counted, refused
from . import Given
from ._reading import counts_in_si, in_si, lattice, one_of, start_of

name = "xela"
refusal = ""
MOST_BYTES = 1 << 30


def sniff(path: str) -> float:
    """A message of the server in the first line."""
    first = start_of(path, 1 << 16).partition(b"\n")[0]
    if not first.lstrip().startswith(b"{"):
        return 0.0
    try:
        told = json.loads(first)
    except (ValueError, RecursionError):
        return 0.0
    return 0.9 if isinstance(told, dict) and any(_is_sensor(key, one) for key, one in told.items()) else 0.0


def geometry(path: str, given: Given) -> Geometry:
    """A flat lattice, z out of the pad."""
    parts = (given.model or "").lower().split("x")
    if len(parts) != 2 or not all(one.isdecimal() and 0 < int(one) <= 256 for one in parts):
        raise refused(path, "has no places of its taxels", 'geometry=, or model="4x6" with pitch= [m] of a flat one')
    places = lattice(path, given, int(parts[0]), int(parts[1]))
    normals = np.broadcast_to([0.0, 0.0, 1.0], places.shape)
    return Geometry(places, normals, reads=QUANTITIES["force"], file=path)


def frames(path: str, given: Given) -> Frames:
    """Forces along the sensor's axes: the calibrated ones in units=, or counts less those of the first frame times gain=.

    Both are taken as forces on the sensor, z out of it: gain=(1, 1, -1) where z grows as the skin is pressed.
    """
    messages = _messages(path)
    sensor = one_of(path, (key for one in messages for key in one if _is_sensor(key, one[key])), given.name, "sensor")
    told = [one[sensor] for one in messages if _is_sensor(sensor, one.get(sensor))]
    times = [one.get("time") for one in told]
    t = np.array(times, dtype=float) if all(isinstance(one, int | float) and one < 1e300 for one in times) else None
    if given.reads != "stress" and all(isinstance(one.get("calibrated"), list) and one["calibrated"] for one in told):
        values = in_si(path, _triples(path, [one["calibrated"] for one in told], float), given, "force")
        return Frames(values, t, "N", "sensor", notes=_notes(messages, told), file=path)
    counts = _triples(path, [str(one.get("data", "")).split(",") for one in told], lambda text: float(int(text, 16)))
    values, unit, noise = counts_in_si(path, counts - counts[:1], given)
    return Frames(
        values, t, unit, "sensor", noise, (*_notes(messages, told), "readings are less those of the first frame"), path
    )


def _notes(messages: list[Any], told: list[Any]) -> tuple[str, ...]:
    others = len(messages) - len(told)
    return (f"{counted(others, 'message')} of other kinds were skipped",) if others else ()


def _is_sensor(key: str, message: Any) -> bool:
    return key.isdecimal() and isinstance(message, dict) and ("data" in message or "calibrated" in message)


def _messages(path: str) -> list[dict[str, Any]]:
    if os.path.getsize(path) > MOST_BYTES:
        raise refused(path, f"has more than {MOST_BYTES >> 30} GiB", "cut it into parts")
    found = []
    with open(path, encoding="utf-8", errors="replace") as file:
        for k, line in enumerate(file):
            if not line.strip():
                continue
            try:
                message = json.loads(line)
            except (ValueError, RecursionError):
                raise refused(
                    path, f"has no message of JSON in line {k + 1}", "one message of the server a line"
                ) from None
            if isinstance(message, dict):
                found.append(message)
    return found


def _triples(path: str, rows: list[list[Any]], number: Any) -> NDArray[np.float64]:
    """(T, taxels, 3)"""
    sizes = {len(row) for row in rows}
    if len(sizes) != 1 or next(iter(sizes)) % 3:
        raise refused(path, f"has messages of {sorted(sizes)} numbers, not x, y and z of the same taxels in each")
    try:
        values = np.array([[number(one) for one in row] for row in rows], dtype=float)
    except (OverflowError, TypeError, ValueError) as error:
        raise refused(path, f"has a reading that is no number: {error}") from None
    return values.reshape(len(rows), -1, 3)

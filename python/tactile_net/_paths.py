"""Values in tables by their dotted paths."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any

from ._tables import as_table


def replaced(tables: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a scene's tables with other values; None takes a key out. Raises KeyError where a list has no such entry."""
    table: dict[str, Any] = copy.deepcopy(dict(tables))
    for path, value in changes.items():
        *way, last = path.split(".")
        place: Any = table
        for step in way:
            place = _within(place, step, path)
        if not isinstance(place, (list, dict)):
            raise KeyError(f"{path}: {way[-1]} is not a table")
        if isinstance(place, list):
            place[_index(place, last, path)] = as_table(value)
        elif value is None:
            place.pop(last, None)
        else:
            place[last] = as_table(value)
    return table


def _within(place: Any, step: str, path: str) -> Any:
    if isinstance(place, list):
        return place[_index(place, step, path)]
    if not isinstance(place, dict):
        raise KeyError(f"{path}: {step} is in no table")
    return place.setdefault(step, {})


def _index(place: Sequence[Any], step: str, path: str) -> int:
    if not step.isdecimal() or int(step) >= len(place):
        raise KeyError(f"{path}: there is no number {step} of {len(place)}")
    return int(step)

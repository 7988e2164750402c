"""Dictionaries as TOML: what a scene says, in the words that its one reader reads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

_DEEPEST = 32  # tables in one another: a table that holds itself is deeper


def text_of(table: Mapping[str, Any]) -> str:
    """A document; keys whose value is None are left out.

    Raises TypeError for what TOML cannot hold: a set, an object, a table in itself.
    """
    import tomli_w  # here, for the time it takes

    return tomli_w.dumps(_plain(table, ()))


def _plain(value: Any, path: tuple[str, ...]) -> Any:
    """The same without NumPy's types and without None."""
    where = ".".join(path)
    if len(path) > _DEEPEST:
        raise TypeError(f"{'.'.join(path[:4])} ... is nested more than {_DEEPEST} deep")
    if isinstance(value, Mapping):
        strange = [key for key in value if not isinstance(key, str)]
        if strange:
            raise TypeError(f"the keys of a scene are strings (got {strange[0]!r})")
        return {key: _plain(inner, (*path, key)) for key, inner in value.items() if inner is not None}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist(), path)
    if isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, Sequence) and not isinstance(value, bytes | bytearray):
        return [_plain(inner, (*path, str(place))) for place, inner in enumerate(value)]
    raise TypeError(f"{where} is a {type(value).__name__}, which no scene holds")

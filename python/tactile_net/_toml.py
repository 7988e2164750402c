"""Dictionaries as TOML: what a scene says, in the words that its one reader reads."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_ESCAPES = str.maketrans({chr(i): f"\\u{i:04x}" for i in [*range(32), 127]} | {'"': '\\"', "\\": "\\\\"})
_DEEPEST = 32  # tables in one another: a table that holds itself is deeper


def text_of(table: Mapping[str, Any]) -> str:
    """A document; keys whose value is None are left out.

    Raises TypeError for what TOML cannot hold: a set, an object, a table in itself.
    """
    return "\n".join(_lines(table, (), 0)) + "\n"


def _lines(table: Mapping[str, Any], path: tuple[str, ...], depth: int) -> list[str]:
    if depth > _DEEPEST:
        raise TypeError(f"{'.'.join(path[:4])} ... is nested more than {_DEEPEST} deep")
    own: list[str] = []
    below: list[str] = []
    for key, value in table.items():
        if not isinstance(key, str):
            raise TypeError(f"the keys of a scene are strings (got {key!r})")
        here = (*path, key)
        if value is None:
            continue
        if isinstance(value, Mapping):
            below += ["", f"[{_name(here)}]", *_lines(value, here, depth + 1)]
        elif _is_list(value) and len(value) > 0 and all(isinstance(v, Mapping) for v in value):
            for one in value:
                below += ["", f"[[{_name(here)}]]", *_lines(one, here, depth + 1)]
        else:
            own.append(f"{_key(key)} = {_value(value, here, depth)}")
    return own + below


def _value(value: Any, path: tuple[str, ...], depth: int) -> str:
    if depth > _DEEPEST:
        raise TypeError(f"{'.'.join(path[:4])} is nested more than {_DEEPEST} deep")
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value)) if math.isfinite(value) else str(float(value))
    if isinstance(value, Mapping):
        inside = (f"{_key(k)} = {_value(v, path, depth + 1)}" for k, v in value.items() if v is not None)
        return "{ " + ", ".join(inside) + " }"
    if _is_list(value):
        return "[" + ", ".join(_value(v, path, depth + 1) for v in value) + "]"
    raise TypeError(f"{'.'.join(path)} is a {type(value).__name__}, which no scene holds")


def _is_list(value: Any) -> bool:
    return isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes))


def _string(text: str) -> str:
    return f'"{text.translate(_ESCAPES)}"'


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _string(key)


def _name(path: tuple[str, ...]) -> str:
    return ".".join(map(_key, path))

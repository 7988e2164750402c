"""Who is told what a long computation is doing."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

Progress: TypeAlias = bool | Callable[[str], None]


@contextmanager
def listening(progress: Progress) -> Iterator[Callable[[str], None] | None]:
    """False: nobody; True: a bar, where tqdm is installed; else who is called with a sentence at each step."""
    if not progress:
        yield None
    elif callable(progress):
        yield progress
    else:
        try:
            auto: Any = importlib.import_module("tqdm.auto")
        except ImportError:
            yield None
            return
        with auto.tqdm(bar_format="{desc} {elapsed}") as bar:
            yield bar.set_description_str

"""Packages that are used where they are installed, and parts of this one that a wheel may lack."""

from __future__ import annotations

import importlib
from typing import Any


def optional(module: str, extra: str) -> Any:
    """The module; ImportError says how to come by it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        raise ImportError(f"this needs {package}: pip install {package}, or tactile-net[{extra}]") from error


def part(name: str) -> Any:
    """The module `tactile_net.NAME`; ImportError says that the wheel was built without it."""
    module = f"{__package__}.{name}"
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module:
            raise
        raise ImportError(
            f"this tactile-net was built without {module}: build the wheel with python/{name}, then pip install "
            f"tactile-net[{name}]"
        ) from None

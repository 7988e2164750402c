"""JSON documents as dictionaries."""

from __future__ import annotations

from typing import Any


def parsed(text: str) -> dict[str, Any]:
    import json  # here, since it takes as long to import as this package does

    document: dict[str, Any] = json.loads(text)
    return document

"""Bytes of a message, with its type's text, as an object."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from ._optional import optional
from ._refusal import refused

_FORMS = ("ros2msg", "ros1msg", "ros2idl")


def decoder(where: str, topic: str, encoding: str, kind: str, form: str, text: str) -> Callable[[bytes], Any]:
    """encoding: of the messages; kind: the name of their type; form: the language of its text."""
    if encoding == "json":
        return json.loads
    if encoding not in ("cdr", "ros1") or form not in _FORMS:
        how = f"{encoding} ({form})" if form else encoding
        raise refused(where, f"has messages of {topic} in {how}; read are cdr and ros1 with their types, and json")
    typesys = optional("rosbags.typesys", "logs")
    store = typesys.get_typestore(typesys.Stores.EMPTY)
    name = kind if "/msg/" in kind else kind.replace("/", "/msg/")
    idl = form == "ros2idl"
    store.register(typesys.get_types_from_idl(text) if idl else typesys.get_types_from_msg(text, name))
    deserialize = store.deserialize_cdr if encoding == "cdr" else store.deserialize_ros1

    def decode(data: bytes) -> Any:
        try:
            return deserialize(data, name)
        except Exception as error:  # the library raises what the bytes make it raise
            raise refused(where, f"has a message of {topic} that is no {name}: {error}") from None

    return decode

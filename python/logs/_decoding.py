"""Bytes of a message, with its type's text, as an object."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from .._optional import optional
from .._refusal import refused

_FORMS = ("ros2msg", "ros1msg", "ros2idl")


def decoder(where: str, topic: str, encoding: str, kind: str, form: str, text: bytes) -> Callable[[bytes], Any]:
    """encoding: of the messages; kind: the name of their type; form: the language of its text."""
    ros = encoding in ("cdr", "ros1") and form in _FORMS
    if not ros and encoding != "json":
        how = f"{encoding} ({form})" if form else encoding
        raise refused(where, f"has messages of {topic} in {how}; readable are cdr and ros1 with their types, and json")
    try:
        deserialize = _of_ros(encoding, kind, form, text.decode()) if ros else json.loads
    except Exception as error:  # the libraries raise what the text, or the bytes, make them raise
        raise refused(where, f"has messages of {topic} whose type {kind} cannot be read: {error}") from None

    def decode(data: bytes) -> Any:
        try:
            return deserialize(data)
        except Exception as error:  # as above
            raise refused(where, f"has a message of {topic} that is not a {kind or encoding}: {error}") from None

    return decode


def _of_ros(encoding: str, kind: str, form: str, text: str) -> Callable[[bytes], Any]:
    typesys = optional("rosbags.typesys", "logs")
    store = typesys.get_typestore(typesys.Stores.EMPTY)
    name = kind if "/msg/" in kind else kind.replace("/", "/msg/")
    idl = form == "ros2idl"
    store.register(typesys.get_types_from_idl(text) if idl else typesys.get_types_from_msg(text, name))
    deserialize = store.deserialize_cdr if encoding == "cdr" else store.deserialize_ros1
    return lambda data: deserialize(data, name)

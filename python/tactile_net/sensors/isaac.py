"""Isaac Capture (Isaac Teleop): MCAP with FlatBuffers, a force of three float32 [N] a taxel, and the taxels' bind poses [m].

Fields are found by the schema in the file: the one vector of structs x, y, z is the forces; of poses, that of as many taxels is
the layout. Along which axes the forces are, the file does not say: frame=."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._arrays import Floats
from .._geometry import QUANTITIES, Frames, Geometry
from .._optional import optional
from .._refusal import refused
from . import Given
from ._flatbuffer import Schema
from ._reading import gains, one_of, start_of

name = "isaac"
refusal = ""
_XYZ = ("x", "y", "z")
MOST_MESSAGES = 1 << 22


def sniff(path: str) -> float:
    """An MCAP that begins with a FlatBuffers schema of something tactile."""
    start = start_of(path, 1 << 20)
    if not start.startswith(b"\x89MCAP0\r\n") or b"flatbuffer" not in start:
        return 0.0
    return 0.9 if b"Tactile" in start or b"taxel" in start else 0.3


def geometry(path: str, given: Given) -> Geometry:
    """Of the taxels' bind poses; normals are fitted to their places."""
    topic, forces = _forces(path, given)
    count = forces[1].shape[1]
    layouts: dict[str, Floats] = {}
    for found, _, arrays in _messages(path):
        for field, columns in arrays.items():
            places = _places(columns)
            if places is not None and len(places) == count:
                layouts.setdefault(f"{found}:{field}", places)
    if not layouts:
        raise refused(path, f"has no poses of the {count} taxels of {topic}", "geometry= a tn.Geometry, or its CSV")
    near = [one for one in layouts if one.partition(":")[0].rsplit("/", 1)[0] == topic.rsplit("/", 1)[0]] or list(
        layouts
    )
    taxels = [one for one in near if "taxel" in one.rpartition(":")[2].lower()] or near
    if len(taxels) > 1:
        raise refused(
            path, f"has several layouts of {count} taxels: {', '.join(taxels)}", "geometry= a tn.Geometry, or its CSV"
        )
    return Geometry(layouts[taxels[0]], reads=QUANTITIES["force"], file=path)


def frames(path: str, given: Given) -> Frames:
    """Forces on the taxels [N]; times are those of the log."""
    topic, (stamps, values) = _forces(path, given)
    if given.frame not in ("sensor", "local"):
        raise refused(
            path,
            f"does not say along which axes the forces of {topic} are",
            'frame="sensor": those of the taxels\' places; frame="local": x into the pad, y and z along it; gain= turns signs',
        )
    t = (stamps - stamps[0]) * 1e-9
    return Frames(values * gains(path, given, 3), t.astype(float), "N", given.frame, file=path)


def _forces(path: str, given: Given) -> tuple[str, tuple[Any, Floats]]:
    """The topic with forces: log times [ns], and (T, N, 3)."""
    found: dict[str, list[tuple[int, Floats]]] = {}
    for topic, stamp, arrays in _messages(path):
        triples = [columns for columns in arrays.values() if tuple(columns) == _XYZ]
        if len(triples) == 1:
            found.setdefault(topic, []).append((stamp, np.stack([triples[0][axis] for axis in _XYZ], axis=1)))
    topic = one_of(path, found, given.name, "topic of forces")
    counts = {len(values) for _, values in found[topic]}
    if len(counts) != 1 or 0 in counts:
        raise refused(path, f"has messages of {sorted(counts)} taxels in {topic}", "a stream has one number of taxels")
    stamps, values = zip(*found[topic], strict=True)
    return topic, (np.array(stamps, dtype=np.int64), np.stack(values))


def _places(columns: dict[str, Floats]) -> Floats | None:
    """Of a vector of poses: three numbers of a position, and a quaternion beside them."""
    position = [one for one in columns if "pos" in one.lower()]
    axes = [one.rpartition(".")[2].rpartition("_")[2] for one in position]
    return np.stack([columns[one] for one in position], axis=1) if axes == list(_XYZ) and len(columns) == 7 else None


def _messages(path: str) -> Any:
    """Topic, log time [ns] and arrays of every message in FlatBuffers."""
    reader = optional("mcap.reader", "logs")
    if start_of(path, 8) != b"\x89MCAP0\r\n":
        raise refused(path, "is no MCAP", "a recording of Isaac Capture")
    schemas: dict[int, Schema | None] = {}
    try:
        with open(path, "rb") as file:
            for k, (schema, channel, message) in enumerate(reader.make_reader(file).iter_messages()):
                if k >= MOST_MESSAGES:
                    raise refused(path, f"has more than {MOST_MESSAGES} messages", "cut it into parts")
                if schema is None or channel.message_encoding != "flatbuffer":
                    continue
                if schema.id not in schemas:
                    schemas[schema.id] = Schema(schema.data) if schema.data[4:8] == b"BFBS" else None
                known = schemas[schema.id]
                if known is not None:
                    yield channel.topic, message.log_time, known.arrays(message.data)
    except (ValueError, IndexError, UnicodeDecodeError, EOFError) as error:
        if type(error).__name__ == "InputError":
            raise
        raise refused(
            path, f"has a message that is not as its schema says: {error}", "was it copied as a whole?"
        ) from None
    except Exception as error:  # the package raises what the bytes make it raise
        if type(error).__module__.startswith("mcap"):
            raise refused(path, f"is not a whole MCAP: {error}", "mcap recover mends most") from None
        raise

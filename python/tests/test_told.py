"""What a result tells is there under the names of its JSON, and each name is described."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from typing import Any

import pytest

import tactile_net as tn


def names(value: Any, prefix: str = "") -> Iterator[str]:
    if isinstance(value, list):
        for one in value:
            yield from names(one, prefix)
    elif isinstance(value, dict) and value.keys() - {"interval"} != {"value", "deviation"}:
        for name, one in value.items():
            yield prefix + name
            yield from names(one, f"{prefix}{name}.")


@pytest.fixture(params=["two", "skin"])
def of_either(request: pytest.FixtureRequest) -> tn.Scene:
    scene = request.getfixturevalue(request.param)
    assert isinstance(scene, tn.Scene)
    return scene


def test_every_number_is_an_attribute_and_is_described(of_either: tn.Scene) -> None:
    recording = of_either.simulate()
    for kind, result in {
        "run": tn.run(of_either),
        "solve": recording.solve(),
        "check": recording.check(),
        "identify": of_either.identify(),
    }.items():
        document = result.to_dict()
        assert document["kind"] == kind
        assert {name for name in document} <= set(dir(result.told))
        # Words of a document's own stand for objects' keys there: names of channels, of effects.
        described = {key.name for key in tn.keys(kind)}
        free = ("readings.", "taxels.", "findings.", "scene.", "verdicts.")
        assert {name for name in names(document) if not name.startswith(free)} <= described
    assert {key.unit for key in tn.keys("solve") if key.name == "shown.patches.ellipse.radius"} == {"m"}


def test_told_has_what_json_has(of_either: tn.Scene) -> None:
    result = tn.run(of_either)
    told, answer = result.told, result.to_dict()["reconstructions"][0]
    first = told.reconstructions[0]
    assert first.verdict == answer["verdict"] and first.alpha == answer["alpha"]
    normal = answer["resultant"]["normal"]
    assert first.resultant.normal[:2] == (normal["value"], normal["deviation"])
    assert first.resultant.normal.deviation > 0.0
    if "interval" in normal:
        assert first.resultant.normal.interval.low == normal["interval"]["low"]
    assert first.to_dict() == answer and first == pickle.loads(pickle.dumps(first))
    with pytest.raises(AttributeError, match="no 'forse': method, verdict, alpha"):
        _ = first.forse


def test_an_unknown_kind_is_named() -> None:
    with pytest.raises(ValueError, match="chekc"):
        tn.keys("chekc")

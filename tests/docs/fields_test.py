#!/usr/bin/env python3
"""The tables of a page's keys are those of the schemas: fields_test.py COMMAND PAGE [--write]

A table stands between one of these lines and `<!-- end -->`:
    <!-- keys of KIND.KEY without KEY, KEY -->  of a document, or of the object KEY in it; KIND[1] is its second form
    <!-- values of KIND.KEY -->                 of words
    <!-- kinds of KIND.KEY -->                  of objects that are told apart by their `kind`
`--write` puts into the page what `tactile-net schema KIND` says now.
"""

import json
import pathlib
import re
import subprocess
import sys

tool, page = sys.argv[1], pathlib.Path(sys.argv[2])
text = page.read_text(encoding="utf-8")


def schema(kind):
    return json.loads(subprocess.run([tool, "schema", kind], capture_output=True, text=True, check=True).stdout)


def inner(part):
    """The object that a value is, or that a list is of."""
    if "anyOf" in part:
        return inner(part["anyOf"][0])
    return inner(part["items"]) if "items" in part else part


def words(part):
    """The words that a value may be; none: it is no word."""
    return [one["const"] for one in part.get("oneOf", []) if "const" in one]


def keys(part, prefix="", without=()):
    """(key, unit, sentence) of each value, those inside objects behind them."""
    for key, value in part.get("properties", {}).items():
        if "description" in value and key not in without:
            inside = inner(value)
            choice = "".join(f" `{word}`" for word in words(inside))
            yield prefix + key, value.get("unit", ""), value["description"] + choice
            if set(inside.get("properties", {})) != {"value", "deviation"}:  # every such number has these
                yield from keys(inside, f"{prefix}{key}.")


def parts_of(match):
    """What a table is of, of each form that the document may have."""
    whole = schema(match["kind"])
    forms = whole.get("oneOf", [whole])
    for part in forms if not match["form"] else [forms[int(match["form"])]]:
        for key in match["key"].split(".") if match["key"] else ():
            part = inner(part["properties"][key])
        yield part


def part_of(match):
    return next(parts_of(match))


def merged(lines, skins):
    """The keys of both, those of skins alone behind what they follow there."""
    order, last = list(lines), -1
    for name in skins:
        if name not in lines:
            last += 1
            while last < len(order) and order[last] not in skins and parent(order[last]) == parent(name):
                last += 1
            order.insert(last, name)
        last = order.index(name)
    return order


def parent(name):
    return name.rpartition(".")[0]


def rows_of_keys(match):
    """Where a document has two forms, these are of lines and of skins."""
    without = match["without"].split(", ") if match["without"] else ()
    yield "| key | unit | what it is |\n|---|---|---|\n"
    sides = [{name: rest for name, *rest in keys(part, without=without)} for part in parts_of(match)]
    lines, skins = sides[0], sides[-1]
    for name in merged(lines, skins):
        told = [(lines.get(name), "")] if lines.get(name) == skins.get(name) else [
            (lines.get(name), "Of lines. "), (skins.get(name), "Of skins. ")]
        for row, of in told:
            if row:
                sentence = row[1].replace("|", chr(92) + "|").replace("<", "&lt;")
                yield f"| `{name}` | {row[0]} | {of}{sentence} |\n"


def rows_of_values(match):
    yield "| value | what it means |\n|---|---|\n"
    for one in part_of(match)["oneOf"]:
        yield f"| `{one['const']}` | {one['description']} |\n"


def rows_of_kinds(match):
    yield "| kind | what was seen | its numbers |\n|---|---|---|\n"
    for one in part_of(match)["oneOf"]:
        numbers = [f"`{name}`{f' [{unit}]' if unit else ''}: {sentence}"
                   for name, unit, sentence in keys(one, without=("text", "advice"))]
        yield f"| `{one['properties']['kind']['const']}` | {one['description']} | {' '.join(numbers)} |\n"


def table(match):
    rows = {"keys": rows_of_keys, "values": rows_of_values, "kinds": rows_of_kinds}[match["what"]]
    return match["begin"] + "".join(rows(match)) + match["end"]


made = re.sub(r"(?P<begin><!-- (?P<what>keys|values|kinds) of (?P<kind>\w+)(?:\[(?P<form>\d)\])?(?:\.(?P<key>[\w.]+))?"
              r"(?: without (?P<without>[\w, ]+))? -->\n\n).*?(?P<end>\n<!-- end -->)", table, text, flags=re.DOTALL)
if "--write" in sys.argv:
    page.write_text(made, encoding="utf-8")
elif made == text:
    print("as the schemas say")
else:
    sys.exit(f"{page}: a table of keys is not what the schemas say: python3 {sys.argv[0]} COMMAND {page} --write, and read the change")

#!/usr/bin/env python3
"""The tables of a page's keys are those of the schemas: fields_test.py COMMAND PAGE [--write]

A table stands between `<!-- keys of KIND -->` or `<!-- kinds of KIND.KEY -->`, whose objects are told apart by their `kind`, and
`<!-- end -->`. `--write` puts into the page what `tactile-net schema KIND` says now.
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
    return inner(part["items"]) if "items" in part else part


def keys(part, prefix=""):
    """(key, unit, sentence) of each value, those inside objects behind them."""
    for key, value in part.get("properties", {}).items():
        if "description" in value:
            yield prefix + key, value.get("unit", ""), value["description"]
            yield from keys(inner(value), f"{prefix}{key}.")


def rows_of_keys(kind, _):
    yield "| key | unit | what it is |\n|---|---|---|\n"
    for key, unit, sentence in keys(schema(kind)):
        yield f"| `{key}` | {unit} | {sentence} |\n"


def rows_of_kinds(kind, key):
    yield "| kind | what was seen | its numbers |\n|---|---|---|\n"
    for one in schema(kind)["properties"][key]["items"]["oneOf"]:
        numbers = [f"`{name}`{f' [{unit}]' if unit else ''}: {sentence}" for name, unit, sentence in keys(one)
                   if name not in ("text", "advice")]
        yield f"| `{one['properties']['kind']['const']}` | {one['description']} | {' '.join(numbers)} |\n"


def table(match):
    rows = rows_of_keys if match["what"] == "keys" else rows_of_kinds
    return match["begin"] + "".join(rows(match["kind"], match["key"])) + match["end"]


made = re.sub(r"(?P<begin><!-- (?P<what>keys|kinds) of (?P<kind>\w+)(?:\.(?P<key>\w+))? -->\n\n).*?(?P<end>\n<!-- end -->)", table, text,
              flags=re.DOTALL)
if "--write" in sys.argv:
    page.write_text(made, encoding="utf-8")
elif made == text:
    print("as the schemas say")
else:
    sys.exit(f"{page}: a table of keys is not what the schemas say: python3 {sys.argv[0]} COMMAND {page} --write, and read the change")

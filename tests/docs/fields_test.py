#!/usr/bin/env python3
"""The tables of a page's keys, or the attributes of a Python class, are those of the schemas: fields_test.py COMMAND PAGE [--write]

A table stands between one of these lines and `<!-- end -->`:
    <!-- keys of KIND.KEY without KEY, KEY -->  of a document, or of the object KEY in it; KIND[1] is its second form
    <!-- values of KIND.KEY -->                 of words
    <!-- kinds of KIND.KEY -->                  of objects that are told apart by their `kind`
In a class the attributes stand between `# keys of KIND.KEY` and `# end`.
`--write` puts into the page what `tactile-net schema KIND` says now.
"""

import json
import pathlib
import re
import subprocess
import sys
import textwrap

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
            if set(inside.get("properties", {})) - {"interval"} != {"value", "deviation"}:  # every such number has these
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


TYPES = {"integer": "int", "number": "float", "boolean": "bool", "string": "str"}


def python_type(value):
    """Of an attribute, as the package's Told has it."""
    kinds = value["type"] if isinstance(value.get("type"), list) else [value.get("type")]
    unknown = " | None" if "null" in kinds or {"type": "null"} in value.get("anyOf", []) else ""
    if "anyOf" in value:
        return python_type(value["anyOf"][0]) + unknown
    if "array" in kinds:
        size = value.get("minItems")
        inside = python_type(value["items"])
        return f"tuple[{', '.join([inside] * size) if size else inside + ', ...'}]" + unknown
    if "object" in kinds:
        return ("Uncertain" if set(value["properties"]) - {"interval"} == {"value", "deviation"} else "Told") + unknown
    return TYPES[kinds[0]] + unknown


def attributes(match):
    """Annotations and docstrings, of those that one sensor alone has too."""
    parts = [part["properties"] for part in parts_of(match)]
    for name in merged(parts[0], parts[-1]):
        told = []
        for part, of in ((parts[0], "Of lines. "), (parts[-1], "Of skins. ")):
            if name in part:
                unit = part[name].get("unit", "")
                sentence = part[name]["description"].replace("null:", "None:")
                clause = re.match("[^;.]*", sentence).end()
                told.append((of, f"{sentence[:clause]} [{unit}]{sentence[clause:]}" if unit else sentence))
        types = dict.fromkeys(python_type(part[name]) for part in (parts[0], parts[-1]) if name in part)
        same = len(told) == 2 and told[0][1] == told[1][1]
        words = told[0][1] if same else " ".join(of + sentence for of, sentence in told)
        yield f"    {name}: {' | '.join(dict.fromkeys(' | '.join(types).split(' | ')))}\n"
        lines = textwrap.wrap(f'"""{words}', 116)
        yield from (f"    {line}\n" for line in [*lines[:-1], lines[-1] + '"""'])


def python_class(match):
    return match["begin"] + "".join(attributes(match)) + match["end"]


def table(match):
    rows = {"keys": rows_of_keys, "values": rows_of_values, "kinds": rows_of_kinds}[match["what"]]
    return match["begin"] + "".join(rows(match)) + match["end"]


made = re.sub(r"(?P<begin><!-- (?P<what>keys|values|kinds) of (?P<kind>\w+)(?:\[(?P<form>\d)\])?(?:\.(?P<key>[\w.]+))?"
              r"(?: without (?P<without>[\w, ]+))? -->\n\n).*?(?P<end>\n<!-- end -->)", table, text, flags=re.DOTALL)
made = re.sub(r"(?P<begin> *# keys of (?P<kind>\w+)(?P<form>)\.(?P<key>[\w.]+)\n).*?(?P<end> *# end\n)", python_class, made, flags=re.DOTALL)
if "--write" in sys.argv:
    page.write_text(made, encoding="utf-8")
elif made == text:
    print("as the schemas say")
else:
    sys.exit(f"{page}: a table of keys is not what the schemas say: python3 {sys.argv[0]} COMMAND {page} --write, and read the change")

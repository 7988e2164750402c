#!/usr/bin/env python3
"""Writes docs/python-reference.md from the docstrings of what the package exports: reference.py [--check]

Read as text: neither the package nor its module need be built. --check writes nothing, and fails where the page is another.
"""

from __future__ import annotations

import ast
import pathlib
import re
import sys

project = pathlib.Path(__file__).resolve().parents[1]
package = project / "python/tactile_net"
page = project / "docs/python-reference.md"
introduction = """# Python: every name

Made by `python/reference.py` from the docstrings, which `help` shows as well. How the names work together: [python.md](python.md);
what the words of a scene mean: [scene.md](scene.md), [skins.md](skins.md).
"""


def module(name: str) -> ast.Module:
    folder = (package.parent if name in ("logs", "mujoco") else package) / name  # two are parts that a wheel may lack
    file = folder / "__init__.py" if folder.is_dir() else package / f"{name}.py"
    return ast.parse(file.read_text(encoding="utf-8"))


def exports(tree: ast.Module) -> list[str]:
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and node.targets[0].id == "__all__":
            return list(ast.literal_eval(node.value))
    return []


def origins(tree: ast.Module) -> dict[str, tuple[str, str]]:
    """From which module, and by which name there, each imported name is."""
    return {
        alias.asname or alias.name: (node.module, alias.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module
        for alias in node.names
    }


def decorators(node: ast.FunctionDef) -> set[str]:
    return {ast.unparse(one).split("(")[0].split(".")[-1] for one in node.decorator_list}


def signature(name: str, node: ast.FunctionDef) -> str:
    arguments = ast.unparse(node.args)
    if "staticmethod" not in decorators(node):
        arguments = arguments.removeprefix("self").removeprefix("cls").removeprefix(", ").removeprefix("/, ")
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{name}({arguments}){returns}"


def paragraph(node: ast.AST) -> str:
    """A docstring as Markdown. Its lines are sentences and stay as they are; an example among them is indented."""
    parts = (ast.get_docstring(node) or "").strip().split("\n\n")
    return "\n\n".join(re.sub("^", "    ", part, flags=re.MULTILINE) if re.match(r"[\w., ]+ = \w", part) else part for part in parts)


def fields(node: ast.ClassDef) -> list[str]:
    """Fields in the class's body with the string below them, if there is one."""
    lines = []
    for field, below in zip(node.body, [*node.body[1:], None]):
        if not isinstance(field, ast.AnnAssign) or not isinstance(field.target, ast.Name) or field.target.id.startswith("_"):
            continue
        if field.value and "init=False" in ast.unparse(field.value):
            continue
        words = ""
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
            words = ": " + " ".join(str(below.value.value).split())
        default = f" = {ast.unparse(field.value)}" if field.value else ""
        lines.append(f"- `{field.target.id}: {ast.unparse(field.annotation)}{default}`{words}")
    return lines


def members(node: ast.ClassDef) -> list[str]:
    lines = []
    for member in node.body:
        if not isinstance(member, ast.FunctionDef) or "overload" in decorators(member):
            continue
        kinds = decorators(member)
        words = " ".join(paragraph(member).split())
        if member.name == "__call__":
            lines.append(f"- `{signature('', member)}`: {words}")
        elif member.name.startswith("_") or "setter" in kinds or not words:
            continue
        elif kinds & {"property", "cached_property"}:
            returns = f": {ast.unparse(member.returns)}" if member.returns else ""
            lines.append(f"- `{member.name}{returns}`: {words}")
        else:
            lines.append(f"- `{signature(member.name, member)}`: {words}")
    return lines


def inherited(node: ast.ClassDef, tree: ast.Module) -> list[str]:
    """What bases in the same file hold whose names are nobody's business."""
    hidden = {ast.unparse(base) for base in node.bases if ast.unparse(base).startswith("_")}
    bases = [one for one in tree.body if isinstance(one, ast.ClassDef) and one.name in hidden]
    return [line for base in bases for line in fields(base) + members(base)]


def entry(name: str, tree: ast.Module, room: str = "") -> list[str]:
    """A name's heading, signature, docstring and members; nothing for what has no docstring. room: the folder of the module."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and node.name == name:
            bases = ", ".join(ast.unparse(base) for base in node.bases)
            title = f"class {name}({bases})" if bases and not bases.startswith("_") else f"class {name}"
            listed = inherited(node, tree) + fields(node) + members(node)
            return [f"### {name}", "", f"`{title}`", "", paragraph(node), "", *listed, *([""] if listed else [])]
        if isinstance(node, ast.FunctionDef) and node.name == name and "overload" not in decorators(node):
            return [f"### {name}", "", f"`{signature(name, node)}`", "", paragraph(node), ""]
    origin = origins(tree).get(name)
    if not origin:
        return []
    of = room + origin[0].replace(".", "/")
    return entry(origin[1], module(of), f"{of}/" if (package / of).is_dir() else room)


def text() -> str:
    lines = [introduction]
    for title, name in (("tactile_net", "__init__"), ("tactile_net.datasets", "datasets"), ("tactile_net.plot", "plot"), ("tactile_net.sensors", "sensors"),
                        ("tactile_net.logs", "logs"),
                        ("tactile_net.mujoco", "mujoco"), ("tactile_net.errors", "errors")):
        tree = module(name)
        own = {node.name for node in tree.body if isinstance(node, ast.ClassDef | ast.FunctionDef)}
        if name != "__init__":
            own -= {one for one in own if one.startswith("_")}
        names = [one for one in exports(tree) or sorted(own) if not one.startswith("_")]
        lines += [f"## {title}", "", paragraph(tree), ""]
        for one in names:
            lines += entry(one, tree, "sensors/" if name == "sensors" else "")
    return "\n".join(lines).rstrip() + "\n"


if sys.argv[1:] == ["--check"]:
    if not page.exists() or page.read_text(encoding="utf-8") != text():
        sys.exit(f"{page.relative_to(project)} is not what the docstrings say: python3 python/reference.py")
else:
    page.write_text(text(), encoding="utf-8")

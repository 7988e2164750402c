#!/usr/bin/env python3
"""Source that a page shows is what stands in the source: quotes_test.py PROJECT [--write]

A comment <!-- quoted: FILE, NAME --> above a block says where its lines come from: from between the two lines `// [NAME]` of
that file. `--write` puts them into the page as they are now.
"""

import pathlib
import re
import sys

from markdown_page import documents

QUOTED = re.compile(r"<!-- quoted: (\S+), (.+) -->")


def quoted(project, file, name):
    """The lines between the two markers of that name."""
    source = project / file
    if not source.is_file():
        raise ValueError(f"there is no file {file}")
    lines = source.read_text(encoding="utf-8").splitlines()
    marks = [i for i, line in enumerate(lines) if line.strip() == f"// [{name}]"]
    if len(marks) != 2:
        raise ValueError(f"{file} should have two lines // [{name}] and has {len(marks)}")
    return lines[marks[0] + 1 : marks[1]]


def main():
    project = pathlib.Path(sys.argv[1]).resolve()
    faults, count = [], 0
    for page in documents(project):
        lines = page.path.read_text(encoding="utf-8").splitlines()
        blocks = {block.line: block for block in page.blocks}
        for at in range(len(lines), 0, -1):  # from the end: what is written moves only what follows
            found = QUOTED.fullmatch(lines[at - 1])
            if not found:
                continue
            count += 1
            place = f"{page.path.relative_to(project)}:{at}"
            block = blocks.get(at + 1)
            try:
                expected = quoted(project, *found.groups())
            except ValueError as error:
                faults.append(f"{place}: {error}")
                continue
            if block is None:
                faults.append(f"{place}: no block follows in the next line")
            elif block.lines != expected:
                lines[at + 1 : at + 1 + len(block.lines)] = expected
                faults.append(f"{place}: the block is not what stands in {found[1]}; {sys.argv[0]} PROJECT --write puts it there")
        if "--write" in sys.argv:
            page.path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")
    if count == 0:
        faults.append("no page quotes any source")
    print("\n".join(faults) or f"{count} quotes are as in the source")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Every link of the docs leads somewhere, every mention of them in the sources too, and no word is left out: links_test.py PROJECT"""

import pathlib
import re
import sys

from markdown_page import documents

project = pathlib.Path(sys.argv[1])
pages = {page.path.resolve(): page for page in documents(project)}
faults = []


def fault(path, line, words):
    faults.append(f"{path.relative_to(project)}:{line}: {words}")


for page in pages.values():
    for line, target in page.links():
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        there = (page.path.parent / name).resolve() if name else page.path.resolve()
        if not there.exists():
            fault(page.path, line, f"there is no {target}")
        elif anchor and (there not in pages or anchor not in pages[there].anchors()):
            fault(page.path, line, f"there is no heading #{anchor} in {name or 'this page'}")
    for line, text in page.prose:
        if re.match(r" {4}(\$ |tactile-net |tools/|cmake |ngspice )", text):
            fault(page.path, line, "commands stand in a block ```sh or ```console, so that a test runs them")

# A page that is on no road is not found.
reached, ahead = set(), [(project / "README.md").resolve()]
while ahead:
    page = pages.get(ahead.pop())
    if page is None or page.path in reached:
        continue
    reached.add(page.path)
    ahead += [(page.path.parent / target.partition("#")[0]).resolve() for _, target in page.links()]
    ahead += [p / "README.md" for p in ahead if p.is_dir()]
for page in pages.values():
    if page.path not in reached and page.path.name != "CHANGELOG.md":
        fault(page.path, 1, "no page links to this one")

# The site shows each page once, and no page that is not there.
navigation = project / "docs/mkdocs.yml"
shown = [project / name for name in re.findall(r"^ +- (?:.*: )?(\S+\.md)$", navigation.read_text(encoding="utf-8"), re.MULTILINE)]
for page in pages.values():
    if shown.count(page.path) != 1:
        fault(navigation, 1, f"{page.path.relative_to(project)} is in it {shown.count(page.path)} times")
for path in shown:
    if path.resolve() not in pages:
        fault(navigation, 1, f"there is no page {path.relative_to(project)}")

# The headers that the lists of words name.
for glossary in (project / "docs/glossary.md", project / "docs/internals/words.md"):
    for line, text in pages[glossary.resolve()].prose:
        for header in re.findall(r"`([\w/]+\.hpp)`", text):
            if not (project / "include/tactile_net" / header).exists():
                fault(glossary, line, f"there is no header {header}")

# Every verdict that the program can give.
concepts = project / "docs/concepts.md"
verdicts = re.findall(r"\{Verdict::\w+, \"(\w+)\"\}", (project / "src/lab/verdict.cpp").read_text(encoding="utf-8"))
explained = set(re.findall(r"`(\w+)`", "".join(text for _, text in pages[concepts.resolve()].prose if text.startswith("| `"))))
for verdict in sorted(set(verdicts) - explained) + ([] if verdicts else ["(none found in src/lab/verdict.cpp)"]):
    fault(concepts, 1, f"the verdict {verdict} is not explained")

for folder in ("include", "src", "tools", "tests", "bench", "examples", "scenes", ".ci"):
    for path in (project / folder).rglob("*"):
        if path.suffix not in (".hpp", ".cpp", ".py", ".txt", ".cmake", ".toml", ".sh", "") or not path.is_file():
            continue
        for line, text in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
            for mention in re.findall(r"docs/[\w./-]+\.(?:md|svg)", text):
                if not (project / mention).exists():
                    fault(path, line, f"there is no {mention}")

print("\n".join(faults) or f"{len(pages)} pages, every link leads somewhere")
sys.exit(1 if faults else 0)

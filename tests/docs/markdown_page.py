"""What the tests of the docs need of Markdown: prose, code blocks, headings, links."""

import dataclasses
import pathlib
import re


@dataclasses.dataclass
class Block:
    """A fenced block: the words of its info string, its lines, and where it begins."""

    words: list[str]
    lines: list[str]
    line: int

    @property
    def language(self):
        return self.words[0] if self.words else ""

    def option(self, name):
        """The value of name=VALUE in the info string; None where it is not given."""
        return next((w.split("=", 1)[1] for w in self.words[1:] if w.startswith(name + "=")), None)

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"


class Document:
    """A Markdown file, its prose (line number, text) apart from its blocks."""

    def __init__(self, path: pathlib.Path):
        self.path = path
        self.prose: list[tuple[int, str]] = []
        self.blocks: list[Block] = []
        open_block = None
        for number, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if text.startswith("```"):
                if open_block is None:
                    open_block = Block(text[3:].split(), [], number)
                else:
                    self.blocks.append(open_block)
                    open_block = None
            elif open_block is not None:
                open_block.lines.append(text)
            else:
                self.prose.append((number, text))
        if open_block is not None:
            raise SystemExit(f"{path}:{open_block.line}: this block is never closed")

    def anchors(self):
        """The names under which a browser finds the headings, as GitHub makes them."""
        found = {}
        for _, text in self.prose:
            heading = re.match(r"#{1,6} +(.*)", text)
            if heading:
                plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).strip().lower()
                slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
                found[slug] = found.get(slug, -1) + 1
        return {slug + (f"-{i}" if i else "") for slug, n in found.items() for i in range(n + 1)}

    def links(self):
        """(line, target) of every link and picture; what stands in `code` is none."""
        for number, text in self.prose:
            text = re.sub(r"`[^`]*`", "", text)
            for target in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text):
                yield number, target


def documents(project: pathlib.Path):
    """Every page that is for people."""
    return [Document(p) for p in sorted([*project.glob("*.md"), *project.glob("docs/**/*.md"), *project.glob("scenes/**/*.md")])]

"""What the pictures of docs/concepts are drawn with."""

import math

from symbols import markup, number

STYLE = """
svg { color: #1c1c1c; --pad: #f3e3d3; --body: #d9d9d9; --normal: #1f5fa8; --drag: #b3401e; --quiet: #6a6a6a; font: 15px sans-serif }
@media (prefers-color-scheme: dark) {
  svg { color: #e8e8e8; --pad: #3a322a; --body: #4a4a4a; --normal: #7db4f0; --drag: #f0906c; --quiet: #a8a8a8 }
}
text { fill: currentColor } .quiet { fill: var(--quiet) }
path { fill: none; stroke: currentColor; stroke-width: 1.5; stroke-linecap: round; stroke-linejoin: round }
.pad { fill: var(--pad); stroke: none } .body { fill: var(--body); stroke: none } .base { stroke-width: 5 }
.taxel { fill: currentColor; stroke: none } .band { fill: var(--normal); fill-opacity: 0.18; stroke: none } .size { stroke: var(--quiet); stroke-width: 1.2 }
.normal { stroke: var(--normal); stroke-width: 2 } .drag { stroke: var(--drag); stroke-width: 2 }
rect.normal { fill: var(--normal); stroke: none } rect.drag { fill: var(--drag); stroke: none } .ring { fill: none; stroke: var(--quiet); stroke-dasharray: 4 4 }
text.normal { fill: var(--normal); stroke: none } text.drag { fill: var(--drag); stroke: none }
"""


def path(words, *steps):
    d = " ".join(s if isinstance(s, str) else f"{number(s[0])} {number(s[1])}" for s in steps)
    return f'<path class="{words}" d="{d}"/>'


def text(x, y, words, anchor="start", kind=""):
    return f'<text class="{kind}" x="{number(x)}" y="{number(y)}" text-anchor="{anchor}">{markup(words)}</text>'


def arrow(kind, start, end, head=6):
    (x, y), (u, v) = start, end
    length = math.hypot(u - x, v - y)
    a, b = (u - x) / length * head, (v - y) / length * head
    return path(kind, "M", start, "L", end, "M", (u - a - b * 0.7, v - b + a * 0.7), "L", end, "L", (u - a + b * 0.7, v - b - a * 0.7))


def size(start, end):
    """A dimension line with an arrow at both ends."""
    return arrow("size", start, end) + arrow("size", end, start)

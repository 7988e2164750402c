#!/usr/bin/env python3
"""Draws the pictures of docs/concepts.md: `python3 tools/schematics/pad.py` writes docs/concepts/*.svg, for light and dark."""

import math
import pathlib

from symbols import markup, number

STYLE = """
svg { color: #1c1c1c; --pad: #f3e3d3; --body: #d9d9d9; --normal: #1f5fa8; --drag: #b3401e; --quiet: #6a6a6a; font: 15px sans-serif }
@media (prefers-color-scheme: dark) {
  svg { color: #e8e8e8; --pad: #3a322a; --body: #4a4a4a; --normal: #7db4f0; --drag: #f0906c; --quiet: #a8a8a8 }
}
text { fill: currentColor } .quiet { fill: var(--quiet) }
path { fill: none; stroke: currentColor; stroke-width: 1.5; stroke-linecap: round; stroke-linejoin: round }
.pad { fill: var(--pad); stroke: none } .body { fill: var(--body); stroke: none } .base { stroke-width: 5 }
.taxel { fill: currentColor; stroke: none } .size { stroke: var(--quiet); stroke-width: 1.2 }
.normal { stroke: var(--normal); stroke-width: 2 } .drag { stroke: var(--drag); stroke-width: 2 }
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


def pad():
    """The pad in section: frame and signs

    The surface runs along y, from left to right; x points down into the pad. A body presses at the centre y*.
    The normal traction p is positive where it presses down, the tangential traction q where it drags along +y. Taxels lie
    in one straight line below the surface, numbered from 0 at the left; y = 0 is the middle of the line.
    """
    left, right, surface, base, depth, pitch, middle = 60, 700, 115, 295, 195, 56, 380
    centre, half = middle + 120, 90
    radius = 400
    drop = radius - math.sqrt(radius**2 - 150**2)
    out = [path("pad", "M", (left, surface), "H", f"{right} V {base} H {left} Z"),
           path("body", "M", (centre - 150, surface - 62 - drop), "A", (radius, radius), "0 0 0", (centre + 150, surface - 62 - drop), "Z"),
           text(centre, surface - 75, "a body presses and drags", "middle")]
    for k in range(-4, 5):
        t = k / 4.5
        x = centre + t * half
        p = 52 * math.sqrt(1 - t * t)
        out += [arrow("normal", (x, surface - 4 - p), (x, surface - 3)), arrow("drag", (x, surface + 10), (x + 6 + p * 0.25, surface + 10), 5)]
    out += [text(centre - half - 14, surface - 44, "$p$ > 0: pressure, the normal traction", "end", "normal"),
            text(centre + half + 20, surface + 22, "$q$ > 0: drag", kind="drag"),
            path("", "M", (left, surface), "H", str(right)), path("base", "M", (left, base), "H", str(right)),
            text(right, base + 24, "rigid base (or none: a half plane)", "end", "quiet")]
    count = 11
    places = [middle + (j - (count - 1) / 2) * pitch for j in range(count)]
    out += [f'<circle class="taxel" cx="{x}" cy="{depth}" r="5"/>' for x in places]
    out += [text(places[0], depth + 24, "taxel 0", "middle"), text(places[-1], depth + 24, "taxel $N$ − 1", "middle"),
            size((places[2], depth + 18), (places[3], depth + 18)), text((places[2] + places[3]) / 2, depth + 38, "pitch", "middle", "quiet"),
            size((places[1], surface + 2), (places[1], depth - 7)), text(places[1] + 8, (surface + depth) / 2 + 12, "depth", kind="quiet"),
            size((left + 10, surface + 2), (left + 10, base - 4)), text(left + 18, base - 14, "thickness", kind="quiet")]
    out += [path("size", "M", (middle, surface - 10), "V", str(surface + 10)), text(middle - 6, surface - 14, "$y$ = 0", "end", "quiet"),
            arrow("", (left - 30, surface), (left - 30, surface + 60)),
            text(left - 34, surface + 80, "$x$", "end"),
            arrow("", (right, surface), (right + 45, surface)), text(right + 50, surface + 5, "$y$"),
            path("size", "M", (centre, surface + 22), "V", str(surface + 52)), text(centre, surface + 67, "centre $y$*", "middle")]
    return 790, 335, out


def low_pass():
    """The pad as a low-pass

    Two loads 2 mm apart on the surface, and the normal stress that they cause at depths of 0.5, 1.5 and 3 mm: the deeper,
    the flatter and the wider; at 3 mm the two can no longer be told apart by eye.
    """
    centres, half, load = (-1.0, 1.0), 0.5, 100.0  # mm, mm, N/m each

    def pressure(y):
        return sum(2 * load / (math.pi * half**2) * math.sqrt(max(0.0, half**2 - (y - c) ** 2)) for c in centres)

    def stress(y, x, steps=400):
        """sigma_x of the half plane: the line load's (Flamant), summed over the contacts."""
        total = 0.0
        for c in centres:
            for k in range(steps):
                angle = math.pi * (k + 0.5) / steps - math.pi / 2  # s = c + half sin(angle) makes the ends smooth
                s = c + half * math.sin(angle)
                weight = half * math.cos(angle) * math.pi / steps
                total += 2 * x**3 / math.pi / (x * x + (y - s) ** 2) ** 2 * pressure(s) * weight
        return total

    left, bottom, width, height = 70, 270, 620, 230
    top = 2 * load / (math.pi * half) * 1.05

    def at(y, value):
        return left + width * (y + 5) / 10, bottom - height * value / top

    def curve(kind, f, style=""):
        points = [at(-5 + k / 40, f(-5 + k / 40)) for k in range(401)]
        return path(kind, "M", points[0], "L", *points[1:]).replace("/>", f"{style}/>")

    out = [path("size", "M", at(-5, 0), "L", at(5, 0))]
    for tick in range(-4, 5, 2):
        x, y = at(tick, 0)
        out += [path("size", "M", (x, y), "v 5"), text(x, y + 22, f"{tick}".replace("-", "−"), "middle", "quiet")]
    out += [text(left + width, bottom + 22, "$y$ [mm]", "end", "quiet"),
            curve("normal", pressure), text(*at(1.45, 108), "pressure on the surface", kind="normal")]
    for depth, dashes, place in ((0.5, "", (1.55, 66)), (1.5, "8 5", (1.85, 35)), (3, "2 5", (2.75, 18))):
        style = f' stroke-dasharray="{dashes}"' if dashes else ""
        out += [curve("", lambda y, depth=depth: stress(y, depth), style), text(*at(*place), f"stress {depth} mm below")]
    return 720, 310, out


if __name__ == "__main__":
    folder = pathlib.Path(__file__).resolve().parents[2] / "docs" / "concepts"
    folder.mkdir(parents=True, exist_ok=True)
    for name, picture in {"pad": pad, "low-pass": low_pass}.items():
        title, description = (" ".join(part.split()) for part in picture.__doc__.split("\n\n"))
        width, height, body = picture()
        svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img">\n'
               f"<title>{title}</title>\n<desc>{description}</desc>\n<style>{STYLE}</style>\n" + "\n".join(body) + "\n</svg>\n")
        (folder / f"{name}.svg").write_text(svg, encoding="utf-8", newline="\n")

"""A sheet of a schematic: wires, symbols and labels on a grid of 10 px, written as SVG.

A symbol's pins are the ends of its leads, and a lead is a wire. Wires that meet at an end are joined: where
three or more do, the sheet draws the dot itself. Wires that cross are not joined. `parts` and `names` say what
was drawn, for check.py.
"""

import math
import re
from xml.sax.saxutils import escape

STYLE = """
svg { color: #1c1c1c; font-family: sans-serif; font-size: 16px }
path, circle, rect { fill: none; stroke: currentColor; stroke-width: 1.6 }
path, circle, rect { stroke-linecap: round; stroke-linejoin: round }
text { fill: currentColor }
.dot { fill: currentColor; stroke: none }
.hollow { fill: #fff }
.active { fill: #f6d9cb }
.fine { stroke-width: 1; stroke: #8a8a8a }
.first { stroke: #1f5fa8; stroke-width: 2.2 }
.second { stroke: #b3401e; stroke-width: 2.2 }
.tangent { stroke-dasharray: 5 5 }
"""


def number(value):
    return f"{round(value, 2):g}"


def on(point, wire):
    (x, y), ((ax, ay), (bx, by)) = point, wire
    beside = abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) > 1e-6
    return not beside and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by)


def markup(text):
    """SVG of a line of text: $...$ is mathematics (letters slanted), _{...} and ^{...} are lowered and raised."""
    out, mathematics, shift = "", False, 0
    for part in re.findall(r"\$|[_^]\{[^}]*\}|[^$_^]+", text):
        if part == "$":
            mathematics = not mathematics
            continue
        level = {"_": 5, "^": -6}.get(part[0], 0)
        for run in re.findall(r"[^\W\d_]+|[\W\d_]+", part[2:-1] if level else part):
            style = ' font-style="italic"' if mathematics and run[0].isalpha() and run != "Σ" else ""
            size = ' font-size="13"' if level else ""
            move = f' dy="{level - shift}"' if level != shift else ""
            run = escape(run).replace("  ", "\u2003")  # the space of an m, which XML keeps
            out += f"<tspan{move}{size}{style}>{run}</tspan>"
            shift = level
    return out


class Sheet:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.wires, self.bodies, self.texts = [], [], []
        self.parts = []  # (kind, ends of its leads at the body, label)
        self.names = []  # (label, point of a wire)

    # Wires

    def wire(self, *points):
        self.wires += [(a, b) for a, b in zip(points, points[1:]) if a != b]

    def name(self, at, label, dx, dy, anchor="start"):
        """A node's name, next to it."""
        self.names.append((label, at))
        self.text((at[0] + dx, at[1] + dy), f"${label}$", anchor)

    def port(self, at, label, dx=-12, dy=5, anchor="end"):
        """A terminal to the rest of the network."""
        self.bodies.append(f'<circle class="hollow" cx="{at[0]}" cy="{at[1]}" r="4.5"/>')
        self.parts.append(("port", [at], label))
        self.name(at, label, dx, dy, anchor)

    def arms(self, at):
        """How many wires leave this point; one that passes through counts twice."""
        return sum(2 - (at in wire) for wire in self.wires if on(at, wire))

    def dots(self):
        points = sorted({point for wire in self.wires for point in wire})
        return [point for point in points if self.arms(point) > 2]

    # Text

    def text(self, at, text, anchor="start", size=16):
        if text.strip("$"):
            self.texts.append(
                f'<text x="{number(at[0])}" y="{number(at[1])}" text-anchor="{anchor}" font-size="{size}">'
                f"{markup(text)}</text>"
            )

    # Symbols with two pins, at a and b

    def two_pins(self, kind, a, b, size, body, label, side):
        """A body of half length and half width `size`, drawn around 0 in the direction of x, put between a and b. Its
        label stands above it or to its right (side = 1), or below it or to its left (-1)."""
        half, width = size
        dx, dy = b[0] - a[0], b[1] - a[1]
        length = math.hypot(dx, dy)
        ux, uy = dx / length, dy / length
        cx, cy = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
        inner = [(cx - half * ux, cy - half * uy), (cx + half * ux, cy + half * uy)]
        self.wire(a, inner[0])
        self.wire(inner[1], b)
        self.parts.append((kind, inner, label))
        angle = math.degrees(math.atan2(dy, dx))
        self.bodies.append(f'<g transform="translate({number(cx)} {number(cy)}) rotate({number(angle)})">{body}</g>')
        if dx and dy:
            place, anchor = (cx + 6 * side, cy - 11 * side), "start" if side > 0 else "end"
        elif dx:
            place, anchor = (cx, cy - width - 12 if side > 0 else cy + width + 19), "middle"
        else:
            place, anchor = (cx + (width + 10) * side, cy + 5), "start" if side > 0 else "end"
        self.text(place, f"${label}$", anchor)

    def resistor(self, a, b, label="", side=1):
        self.two_pins(
            "resistor", a, b, (18, 7), '<rect class="hollow" x="-18" y="-7" width="36" height="14"/>', label, side
        )

    def negative_resistor(self, a, b, label="", side=1):
        body = '<rect class="active" x="-20" y="-9" width="40" height="18"/><path d="M-6 0 h12"/>'
        self.two_pins("negative", a, b, (20, 9), body, label, side)

    def capacitor(self, a, b, label="", side=1):
        self.two_pins("capacitor", a, b, (4, 13), '<path d="M-4 -13 v26 M4 -13 v26"/>', label, side)

    def inductor(self, a, b, label="", side=1):
        self.two_pins("inductor", a, b, (20, 7), '<path d="M-20 0' + " a5 6 0 0 1 10 0" * 4 + '"/>', label, side)

    def n_device(self, a, b, label="", side=1):
        body = '<rect class="active" x="-22" y="-14" width="44" height="28"/><path d="M-15 9 C-7 -24 7 24 15 -9"/>'
        self.two_pins("n device", a, b, (22, 14), body, label, side)

    def current_source(self, a, b, label="", side=1):
        """The current flows from a to b."""
        body = '<circle class="hollow" r="16"/><path d="M-10 0 h19 M4 -5 l6 5 l-6 5"/>'
        self.two_pins("source", a, b, (16, 16), body, label, side)

    # Other symbols

    def ground(self, at):
        x, y = at
        self.wire(at, (x, y + 10))
        self.parts.append(("ground", [(x, y + 10)], ""))
        self.bodies.append(f'<path d="M{x - 11} {y + 10} h22 M{x - 7} {y + 15} h14 M{x - 3} {y + 20} h6"/>')

    def grounded(self, pin, face=1):
        """Ground at an input pin."""
        self.wire(pin, (pin[0] - 10 * face, pin[1]))
        self.ground((pin[0] - 10 * face, pin[1]))

    def sign(self, x, y, plus):
        self.bodies.append(f'<path d="M{x - 5} {y} h10' + (f' M{x} {y - 5} v10"/>' if plus else '"/>'))

    def opamp(self, out, plus="top", face=1):
        """An operational amplifier with its output pin at `out`, facing right (1) or left (-1). Returns its '+' and '-'
        input pins, 90 before the output, 20 above and below it; `plus` says which is which."""
        x, y = out
        base, apex = x - 80 * face, x - 10 * face
        up = -20 if plus == "top" else 20
        pins = [(x - 90 * face, y + up), (x - 90 * face, y - up)]
        for pin in pins:
            self.wire(pin, (base, pin[1]))
        self.wire((apex, y), out)
        self.parts.append(("opamp", [(base, y + up), (base, y - up), (apex, y)], ""))
        self.bodies.append(f'<path class="hollow" d="M{base} {y - 40} L{apex} {y} L{base} {y + 40} Z"/>')
        self.sign(base + 13 * face, y + up, True)
        self.sign(base + 13 * face, y - up, False)
        return pins

    def differential_amplifier(self, centre, minus="top", plus_out="top"):
        """A fully differential amplifier: outputs +x and -x of one core. Returns the pins '+', '-' (inputs, 60 before
        the centre) and +x, -x (outputs, 60 behind it), 20 above and below it."""
        x, y = centre
        base, edge = x - 40, x + 8
        up_in = 20 if minus == "top" else -20
        up_out = -20 if plus_out == "top" else 20
        inner = [(base, y + up_in), (base, y - up_in), (edge, y + up_out), (edge, y - up_out)]
        pins = [(x - 60, y + up_in), (x - 60, y - up_in), (x + 60, y + up_out), (x + 60, y - up_out)]
        for pin, end in zip(pins, inner):
            self.wire(pin, end)
        self.parts.append(("differential", inner, ""))
        self.bodies.append(f'<path class="hollow" d="M{base} {y - 50} L{base + 80} {y} L{base} {y + 50} Z"/>')
        for (px, py), plus in zip(inner, (True, False, True, False)):
            self.sign(base + 13 if px == base else edge - 13, py if px == base else y + (py - y) * 0.8, plus)
        return pins

    # The file

    def svg(self, title, description):
        out = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}"'
            f' viewBox="0 0 {self.width} {self.height}">',
            f"<title>{escape(title)}</title>",
            f"<desc>{escape(description)}</desc>",
            f"<style>{STYLE}</style>",
            f'<rect width="{self.width}" height="{self.height}" rx="8" style="fill:#fff;stroke:none"/>',
        ]
        wires = " ".join(f"M{number(ax)} {number(ay)} L{number(bx)} {number(by)}" for (ax, ay), (bx, by) in self.wires)
        out.append(f'<path d="{wires}"/>')
        out += self.bodies
        out += [f'<circle class="dot" cx="{number(x)}" cy="{number(y)}" r="3.8"/>' for x, y in self.dots()]
        return "\n".join(out + self.texts + ["</svg>", ""])

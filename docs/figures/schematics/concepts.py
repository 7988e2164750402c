#!/usr/bin/env python3
"""Draws the pictures of docs/concepts.md, docs/hand.md and docs/skins.md: `python3 docs/figures/schematics/concepts.py` writes docs/concepts/*.svg, for light and dark."""

import math
import pathlib

from pens import STYLE, arrow, path, size, text
from skin_concepts import arriving_waves, hidden_drags
from symbols import number


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


def surface_grid():
    """Why tractions lie on a grid of their own

    Nine taxels, twice as far apart as they lie deep, and a contact between two of them. A line load over each taxel cannot be
    where the contact is, and misses a part of its force; tractions on a grid find it, with a band that is wide where no taxel looks.
    """
    depth, pitch, load, centre, half, sigma = 1.5, 3.0, 50.0, 1.5, 1.8, 0.2  # mm, N/m, kPa
    taxels = [pitch * (j - 4) for j in range(9)]

    def pressure(y):
        return 2 * load / (math.pi * half**2) * math.sqrt(max(0.0, half**2 - (y - centre) ** 2))

    def kernel(u):
        """sigma_x below a line load of 1 (Flamant)."""
        return 2 * depth**3 / math.pi / (depth**2 + u * u) ** 2

    def integral(weight, a, b, steps=60):
        return sum(weight(a + (b - a) * (k + 0.5) / steps) for k in range(steps)) * (b - a) / steps

    def minimiser(columns, spacing, smoothing, ends):
        """f and its deviations for K'K + alpha h/D (l^2/h^2 Q + I), by elimination; alpha as the command chooses it."""
        readings = [integral(lambda s, y=y: kernel(y - s) * pressure(s), centre - half, centre + half) for y in taxels]
        n, alpha, slope = len(columns), 2.2e-3 * spacing / pitch, (smoothing / spacing) ** 2
        rows = [[sum(a * b for a, b in zip(columns[i], columns[j])) for j in range(n)] for i in range(n)]
        for i in range(n):
            inner = (i > 0) + (i + 1 < n)
            rows[i][i] += alpha * (1 + slope * (2 if ends else inner))
            for j in (i - 1, i + 1):
                if 0 <= j < n:
                    rows[i][j] -= alpha * slope
            rows[i] += [sum(a * g for a, g in zip(columns[i], readings))] + [float(i == j) for j in range(n)]
        for i in range(n):
            pivot = rows[i][i]
            rows[i] = [v / pivot for v in rows[i]]
            for k in range(n):
                if k != i:
                    factor = rows[k][i]
                    rows[k] = [v - factor * w for v, w in zip(rows[k], rows[i])]
        return [row[n] for row in rows], [sigma * math.sqrt(rows[i][n + 1 + i]) for i in range(n)]

    spacing = depth / 4
    grid = [spacing * (k - 39) for k in range(79)]
    hats = [[integral(lambda s, y=y, g=g: kernel(y - s) * (1 - abs(s - g) / spacing), g - spacing, g + spacing, 20) for y in taxels] for g in grid]
    found, deviation = minimiser(hats, spacing, depth, True)
    lines, _ = minimiser([[kernel(y - g) * pitch for y in taxels] for g in taxels], pitch, depth, False)

    left, bottom, width, height = 70, 235, 620, 190

    def at(y, value):
        return left + width * (y + 9) / 18, bottom - height * value / 24

    shown = [k for k in range(79) if abs(grid[k]) <= 9]
    upper = [at(grid[k], found[k] + 2 * deviation[k]) for k in shown]
    lower = [at(grid[k], found[k] - 2 * deviation[k]) for k in reversed(shown)]
    truth = [at(centre + half * k / 40, pressure(centre + half * k / 40)) for k in range(-40, 41)]
    out = [path("body", "M", truth[0], "L", *truth[1:], "Z"),
           path("band", "M", upper[0], "L", *upper[1:], *lower, "Z"),
           path("normal", "M", at(grid[shown[0]], found[shown[0]]), "L", *[at(grid[k], found[k]) for k in shown[1:]])]
    for y, f in zip(taxels, lines):
        x, top = at(y, f)
        out += [path("drag", "M", (x, bottom), "V", str(round(top, 1))), f'<circle class="taxel" cx="{number(x)}" cy="{bottom + 48}" r="5"/>']
    force = sum(lines) * pitch
    out += [path("size", "M", at(-9, 0), "L", at(9, 0)), text(*at(-8.8, 21.5), "a contact between two taxels: 50 N/m", kind="quiet"),
            text(*at(-8.8, 18.5), f"found over the taxels: {force:.0f} N/m", kind="drag"),
            text(*at(-8.8, 15.5), f"found on a grid: {sum(found) * spacing:.0f} N/m, with two deviations", kind="normal"),
            text(left + width, bottom + 75, "taxels, twice as far apart as they lie deep", "end")]
    for tick in range(-6, 7, 3):
        x, y = at(tick, 0)
        out.append(text(x, y + 22, f"{tick}".replace("-", "−"), "middle", "quiet"))
    out.append(text(left + width, bottom + 22, "$y$ [mm]", "end", "quiet"))
    return 780, 330, out


def finger():
    """A finger of a hand file, with its symbols

    The palm's frame X, Y; base, direction, links and angles of a finger; its pad with the frame x, y of the sensor; the
    contact at y* and the force of the object on it, F_v along x and F_t along y.
    """
    scale, origin = 5000.0, (425.0, 470.0)
    base, links, angles, direction = (-0.02, 0.0), (0.05, 0.04), (35.0, -50.0), 90.0
    center, half, height = 0.025, 0.012, 0.005

    def at(point):
        return origin[0] + scale * point[0], origin[1] - scale * point[1]

    def along(point, angle, length):
        return point[0] + length * math.cos(math.radians(angle)), point[1] + length * math.sin(math.radians(angle))

    def arc(center_, start, end, radius, kind="size"):
        """Counter-clockwise if end > start, with an arrow at its end."""
        points = [at(along(center_, start + (end - start) * k / 24, radius)) for k in range(25)]
        return path(kind, "M", points[0], "L", *points[1:]) + arrow(kind, points[-2], points[-1], 5)

    first = direction + angles[0]
    second = first + angles[1]
    joint = along(base, first, links[0])
    tip = along(joint, second, links[1])
    foot = along(joint, second, center)
    middle = along(foot, second - 90, height)  # its pad faces right, seen from the last joint towards the tip
    ends = [along(middle, second, y) for y in (-half, half)]
    back = [along(foot, second, y) for y in (-half, half)]
    contact = along(middle, second, 0.004)

    def outline(*points):
        return path("pad", "M", at(points[0]), "L", *[at(p) for p in points[1:]], "Z")

    out = [outline(ends[0], ends[1], back[1], back[0])]
    for start, end in ((base, joint), (joint, tip)):
        out.append(path("base", "M", at(start), "L", at(end)))
    for point in (base, joint):
        x, y = at(point)
        out.append(f'<circle class="taxel" cx="{number(x)}" cy="{number(y)}" r="8"/>')
    out.append(path("", "M", at(ends[0]), "L", at(ends[1])))
    out += [path("size", "M", at(base), "L", at(along(base, direction, 0.03)), "M", at(joint), "L", at(along(joint, first, 0.025))),
            arc(base, direction, first, 0.024), arc(joint, first, second, 0.02)]
    x, y = at(along(base, direction + 12, 0.029))
    out += [text(x - 8, y - 2, "angle 1", "end", "quiet"), text(*at(along(joint, first + 4, 0.026)), "angle 2 < 0", "end", "quiet")]
    x, y = at(along(base, direction, 0.0315))
    out.append(text(x + 6, y + 6, "direction", "start", "quiet"))
    x, y = at(base)
    out += [text(x + 14, y - 8, "base, joint 1"), arc(base, 200, 320, 0.009), text(x + 2, y + 66, "torques: counter-clockwise", "middle", "quiet")]
    x, y = at(joint)
    out += [text(x - 16, y + 6, "joint 2", "end")]
    x, y = at(along(base, first, 0.014))
    out.append(text(x - 14, y + 4, "link 1", "end"))
    x, y = at(along(joint, second, 0.006))
    out.append(text(x + 12, y + 4, "link 2"))
    x, y = at(tip)
    out.append(text(x, y - 10, "tip", "middle"))
    # The pad: where its middle is, and the sensor's frame.
    gap = along(joint, second + 90, 0.0025), along(foot, second + 90, 0.0025)
    out += [size(at(gap[0]), at(gap[1])), text(at(gap[1])[0] - 8, at(gap[1])[1] + 2, "center of the pad", "end", "quiet")]
    x, y = at(ends[0])
    out.append(text(x + 10, y + 14, "pad, from −half width", kind="quiet"))
    x, y = at(ends[1])
    out += [arrow("", at(ends[1]), at(along(ends[1], second, 0.011))), text(at(along(ends[1], second, 0.011))[0] + 8, at(along(ends[1], second, 0.011))[1] + 4, "$y$")]
    inward = along(contact, second - 90, 0.0135)
    out += [arrow("normal", at(inward), at(along(contact, second - 90, 0.001))), text(at(inward)[0] + 8, at(inward)[1] + 2, "$F_{v}$ along $x$, into the pad", kind="normal"),
            arrow("drag", at(along(contact, second - 90, 0.001)), at(along(along(contact, second - 90, 0.001), second, 0.0085))),
            text(at(along(contact, second, 0.0075))[0] + 14, at(along(contact, second, 0.0075))[1] + 8, "$F_{t}$ along $y$", kind="drag")]
    x, y = at(contact)
    out += [f'<circle class="taxel" cx="{number(x)}" cy="{number(y)}" r="4"/>', text(x + 30, y + 48, "contact, at $y$*"), path("size", "M", (x + 3, y + 4), "L", (x + 27, y + 42))]
    # The palm.
    out += [arrow("", origin, (origin[0] + 60, origin[1])), text(origin[0] + 66, origin[1] + 5, "$X$"),
            arrow("", origin, (origin[0], origin[1] - 60)), text(origin[0] - 4, origin[1] - 66, "$Y$", "middle"),
            text(origin[0] + 6, origin[1] + 22, "the palm's origin", kind="quiet")]
    return 640, 550, out


if __name__ == "__main__":
    folder = pathlib.Path(__file__).resolve().parents[2] / "concepts"
    folder.mkdir(parents=True, exist_ok=True)
    for name, picture in {"pad": pad, "low-pass": low_pass, "grid": surface_grid, "finger": finger,
                          "hidden-drags": hidden_drags, "arriving-waves": arriving_waves}.items():
        title, description = (" ".join(part.split()) for part in picture.__doc__.split("\n\n"))
        width, height, body = picture()
        svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img">\n'
               f"<title>{title}</title>\n<desc>{description}</desc>\n<style>{STYLE}</style>\n" + "\n".join(body) + "\n</svg>\n")
        (folder / f"{name}.svg").write_text(svg, encoding="utf-8", newline="\n")

"""The pictures of docs/skins.md, drawn by concepts.py with its pens: what a skin can tell and what not."""

import math

from pens import arrow, path, text


def stress_x(y, z, depth, loads):
    """Stress across the surface below point loads (y, z, p, q_y, q_z), half space of any Poisson ratio (Boussinesq, Cerruti)."""
    total = 0.0
    for u, v, p, q_y, q_z in loads:
        a, b = y - u, z - v
        total += 3 * depth**2 * (p * depth + q_y * a + q_z * b) / (2 * math.pi * (a * a + b * b + depth**2) ** 2.5)
    return total


def hidden_drags():
    """Drags that the stress across the surface does not show

    Three drags within a circle of 3 mm, seen from outside, and the stress across the surface that each causes 1.5 mm below it. Drags that
    run one way and drags that run apart cause some; drags that run around a point cause none, at no depth.
    """
    radius, depth, cell = 3.0, 1.5, 0.5  # mm
    places = [(cell * (i + 0.5), cell * (j + 0.5)) for i in range(-6, 6) for j in range(-6, 6)]
    places = [(y, z) for y, z in places if math.hypot(y, z) < radius]

    def size(r):
        return math.sqrt(max(0.0, 1 - (r / radius) ** 2))

    def along(y, z):
        return size(math.hypot(y, z)), 0.0

    def apart(y, z):
        return 1.6 * y / radius * size(math.hypot(y, z)), 1.6 * z / radius * size(math.hypot(y, z))

    def around(y, z):
        return -1.6 * z / radius * size(math.hypot(y, z)), 1.6 * y / radius * size(math.hypot(y, z))

    scale, side, gap, top = 20.0, 200.0, 34.0, 46.0
    fields = [("run one way", along), ("run apart", apart), ("run around a point", around)]
    maps = []
    for _, drag in fields:
        loads = [(y, z, 0.0, drag(y, z)[0] * cell**2, drag(y, z)[1] * cell**2) for y, z in places]
        maps.append([[stress_x(0.5 * (i - 9.5), 0.5 * (j - 9.5), depth, loads) for i in range(20)] for j in range(20)])
    most = max(abs(value) for rows in maps for row in rows for value in row)
    out = []
    for k, ((words, drag), rows) in enumerate(zip(fields, maps)):
        left = 20 + k * (side + gap)
        out += [text(left + side / 2, top - 22, f"drags that {words}", "middle", "drag"),
                path("size", "M", (left, top), "h", f"{side}", "v", f"{side}", "h", f"{-side}", "Z"),
                f'<circle class="ring" cx="{left + side / 2}" cy="{top + side / 2}" r="{radius * scale}"/>']
        for y, z in [(1.0 * i, 1.0 * j) for i in range(-2, 3) for j in range(-2, 3) if math.hypot(i, j) < 2.9]:
            q_y, q_z = drag(y, z)
            if math.hypot(q_y, q_z) < 0.1:
                continue
            x0, y0 = left + side / 2 + scale * (y - 0.4 * q_y), top + side / 2 + scale * (z - 0.4 * q_z)
            out.append(arrow("drag", (x0, y0), (x0 + scale * 0.85 * q_y, y0 + scale * 0.85 * q_z), 5))
        below = top + side + 62
        out.append(text(left + side / 2, below - 12, "stress across, 1.5 mm below" if max(abs(value) for row in rows for value in row) > 1e-2 * most else "below: nothing", "middle"))
        for j, row in enumerate(rows):
            for i, value in enumerate(row):
                share = abs(value) / most
                if share > 0.02:
                    kind = "normal" if value > 0 else "drag"
                    out.append(f'<rect class="{kind}" x="{left + i * side / 20:.1f}" y="{below + j * side / 20:.1f}" width="10.2" height="10.2" fill-opacity="{share:.2f}"/>')
        out.append(path("size", "M", (left, below), "h", f"{side}", "v", f"{side}", "h", f"{-side}", "Z"))
    bottom = top + 2 * side + 92
    out.append(text(20, bottom, "blue: pressed, red: pulled. Around a point only shears tell, at whatever depth one reads.", kind="quiet"))
    return 710, bottom + 16, out


def arriving_waves():
    """How much of a ripple arrives at the taxels

    The share of ripples of p, of drag along the wave and of drag across it that readings show, over the wavelength in depths. Where a curl
    falls below the noise the ripple is lost: under one per cent noise at about a depth, under a thousandth at two thirds of one.
    """
    def pressure(a):
        return (1 + a) * math.exp(-a)  # stress_x of p

    def along(a):
        return max(a, abs(1 - a)) * math.exp(-a)  # stress_x or the shear of q along the wave, the larger

    def across(a):
        return math.exp(-a)  # the shear of q across it

    left, bottom, width, height = 80, 300, 600, 260
    longest, shortest, least = 10.0, 0.4, 1e-4

    def at(wave, share):
        return (left + width * math.log(longest / wave) / math.log(longest / shortest), bottom - height * math.log(max(share, least) / least) / math.log(1 / least))

    def lost(curve, noise):
        """The shortest wave above the noise, by halves."""
        low, high = 1e-3, 50.0
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if curve(middle) > noise else (low, middle)
        return 2 * math.pi / low

    out = [path("size", "M", at(longest, least), "L", at(shortest, least)), path("size", "M", at(longest, least), "V", f"{bottom - height}")]
    for wave in (10, 5, 2, 1, 0.5):
        x, y = at(wave, least)
        out += [path("size", "M", (x, y), "v 5"), text(x, y + 22, f"{wave}", "middle", "quiet")]
    out.append(text(left + width, bottom + 44, "wavelength, in depths of the taxels", "end", "quiet"))
    for share, words in ((1, "all of it"), (1e-1, "a tenth"), (1e-2, "1 %"), (1e-3, "0.1 %")):
        x, y = at(longest, share)
        out.append(text(x - 8, y + 5, words, "end", "quiet"))
    for noise in (1e-2, 1e-3):
        (x, y), (u, _) = at(longest, noise), at(shortest, noise)
        out.append(path("size", "M", (x, y), "L", (u, y)).replace("/>", ' stroke-dasharray="6 5"/>'))
        wave = lost(pressure, noise)
        out += [f'<circle class="taxel" cx="{at(wave, noise)[0]:.1f}" cy="{y:.1f}" r="4"/>', text(u + 8, y + 5, f"noise: p lost below {wave:.2g}", kind="quiet")]
    for kind, curve, words, wave in (("normal", pressure, "p", 2.6), ("drag", along, "drag along the wave", 0), ("", across, "drag across it", 0)):
        points = [at(w, curve(2 * math.pi / w)) for w in (longest * (shortest / longest) ** (k / 200) for k in range(201)) if curve(2 * math.pi / w) >= least]
        dashes = ' stroke-dasharray="9 4"' if kind == "drag" else ' stroke-dasharray="2 5"' if not kind else ""
        out.append(path(kind, "M", points[0], "L", *points[1:]).replace("/>", f"{dashes}/>"))
    out += [text(left + 14, 116, "p, as stress across the surface", kind="normal"), text(left + 14, 138, "drag along the wave (dashed)", kind="drag"),
            text(left + 14, 160, "drag across it, as shear (dotted)")]
    return 880, bottom + 60, out

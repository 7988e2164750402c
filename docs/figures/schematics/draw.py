#!/usr/bin/env python3
"""Draws the schematics of docs/circuits.md: `python3 docs/figures/schematics/draw.py` writes docs/circuits/*.svg."""

import math
import pathlib

from symbols import Sheet, number


def three_nodes(sheet, left, step, y, positive, negative, branches, grounds, sources):
    """n_0, n_1, n_2 from left to right, positive branches between neighbours and a negative one between n_0 and n_2."""
    x = [left, left + step, left + 2 * step]
    sheet.name((x[0], y), "n_{0}", -10, -10, "end")
    sheet.name((x[1], y), "n_{1}", 0, -12, "middle")
    sheet.name((x[2], y), "n_{2}", 10, -10)
    positive((x[0], y), (x[1], y), branches[0])
    positive((x[1], y), (x[2], y), branches[1])
    sheet.wire((x[0], y), (x[0], y - 80))
    sheet.wire((x[2], y), (x[2], y - 80))
    negative((x[0], y - 80), (x[2], y - 80), branches[2])
    for k in range(3):
        source, ground = x[k] - 40, x[k] + 40
        sheet.wire((x[k], y), (x[k], y + 40))
        sheet.wire((source, y + 40), (ground, y + 40))
        sheet.current_source((source, y + 130), (source, y + 40), sources[k], -1)
        sheet.ground((source, y + 130))
        positive((ground, y + 40), (ground, y + 130), grounds[k])
        sheet.ground((ground, y + 130))


def ideal():
    """The network of conductances

    Three nodes, a conductance -P_ij between each pair, one of them negative, the row sum of P from
    each node to ground, and a current b_i into each node. The node voltages solve P f = b.
    """
    sheet = Sheet(720, 390)
    branches, grounds = ["−P_{01}", "−P_{12}", "−P_{02} < 0"], ["g_{0}", "g_{1}", "g_{2}"]
    sources = ["b_{0}", "b_{1}", "b_{2}"]
    three_nodes(sheet, 110, 250, 130, sheet.resistor, sheet.negative_resistor, branches, grounds, sources)
    sheet.text((360, 335), "Resistors are labelled with their conductances; the shaded one is negative.", "middle")
    sheet.text((360, 365), "$g_{i} = P_{i0} + P_{i1} + P_{i2}$;  the voltage of $n_{i}$ is $f_{i}$", "middle")
    return sheet


def grounded_nic(sheet, node, label, face=1):
    """A negative conductance from `node` to ground, drawn to the right of it (face = 1) or to the left (-1)."""
    x, y = node

    def at(dx, dy):
        return x + face * dx, y + dy

    p, m = sheet.opamp(at(180, 20), "top", face)
    sheet.wire(node, p)
    sheet.wire(at(50, 0), at(50, -60))
    sheet.resistor(at(50, -60), at(220, -60), label)
    sheet.wire(at(220, -60), at(220, 20), at(180, 20))
    sheet.resistor(at(220, 20), at(220, 90), "R", face)
    sheet.resistor(at(220, 90), at(220, 160), "R", face)
    sheet.ground(at(220, 160))
    sheet.wire(m, at(70, 40), at(70, 90), at(220, 90))


def nic():
    """Negative conductances from operational amplifiers

    (a) Between two nodes: each operational amplifier's + input is at a node, its - input at a tap
    of three equal resistors between the two outputs, and a resistor 1/G leads from the node to the
    output. (b) From a node to ground: the divider ends at ground.
    """
    sheet = Sheet(900, 600)
    sheet.text((30, 35), "(a)  $−G$ between $n_{i}$ and $n_{j}$")
    taps = out_a, m_a, m_b, out_b = (360, 160), (360, 240), (360, 320), (360, 400)
    for y, name, out, tap, plus, outside, side in (
        (140, "n_{i}", out_a, m_a, "top", 80, 1),
        (420, "n_{j}", out_b, m_b, "bottom", 480, -1),
    ):
        p, m = sheet.opamp((270, out[1]), plus)
        sheet.port((70, y), name)
        sheet.wire((70, y), p)
        sheet.wire((120, y), (120, outside))
        sheet.resistor((120, outside), (out[0], outside), "1/G", side)
        sheet.wire((out[0], outside), out, (270, out[1]))
        sheet.wire(m, (150, m[1]), (150, tap[1]), tap)
    for a, b in zip(taps, taps[1:]):
        sheet.resistor(a, b, "R")
    sheet.name(out_a, "$out$_{a} = 2v_{i} − v_{j}", 14, 5)
    sheet.name(m_a, "m_{a} = v_{i}", 14, 5)
    sheet.name(m_b, "m_{b} = v_{j}", 14, 5)
    sheet.name(out_b, "$out$_{b} = 2v_{j} − v_{i}", 14, 5)
    sheet.text((70, 565), "acts as")
    sheet.port((180, 560), "n_{i}")
    sheet.negative_resistor((180, 560), (290, 560), "−G")
    sheet.port((290, 560), "n_{j}", 12, 5, "start")

    sheet.text((550, 35), "(b)  $−G$ from $n_{i}$ to ground")
    sheet.port((570, 140), "n_{i}")
    grounded_nic(sheet, (570, 140), "1/G")
    sheet.name((790, 160), "$out$ = 2v_{i}", 14, 5)
    sheet.name((790, 230), "m = v_{i}", 14, 5)
    sheet.text((560, 565), "acts as")
    sheet.port((670, 560), "n_{i}")
    sheet.negative_resistor((670, 560), (780, 560), "−G")
    sheet.ground((780, 560))
    return sheet


def rail():
    """The network with inverter rails

    An inverter at each node gives the rail r_i = -v_i. Where P_ij is positive, a resistor leads
    from n_i to r_j and one from n_j to r_i; where it is negative, one from n_i to n_j. Each node
    has a current source and a grounded negative conductance.
    """
    sheet = Sheet(900, 690)
    for face, k in ((1, "i"), (-1, "j")):
        n, r = 450 - 380 * face, 450 - 90 * face

        def at(dx, y):
            return n + face * dx, y

        # the inverter
        p, m = sheet.opamp(at(210, 310), "bottom", face)
        sheet.name((n, 290), f"n_{{{k}}}", -12 * face, 5, "end" if face > 0 else "start")
        sheet.resistor((n, 290), at(90, 290), "R_{0}")
        sheet.wire(at(90, 290), m)
        sheet.grounded(p, face)
        sheet.wire(at(90, 290), at(90, 230))
        sheet.resistor(at(90, 230), at(240, 230), "R_{0}")
        sheet.wire(at(240, 230), at(240, 310))
        sheet.wire(at(210, 310), (r, 310))
        sheet.name((r, 310), f"r_{{{k}}} = −v_{{{k}}}", 10 * face, 5, "start" if face > 0 else "end")
        # the node's own elements
        sheet.wire((n, 290), (n, 470))
        grounded_nic(sheet, (n, 450), f"1/G_{{{k}}}", face)
        sheet.current_source((n, 560), (n, 470), f"b_{{{k}}}", -face)
        sheet.ground((n, 560))
    # between the nodes
    sheet.wire((70, 70), (70, 290))
    sheet.wire((830, 70), (830, 290))
    sheet.resistor((70, 70), (830, 70), "|P_{ij}|$ if $P_{ij} < 0")
    sheet.wire((540, 310), (540, 120), (290, 120))
    sheet.resistor((70, 120), (290, 120), "P_{ij}$ if $P_{ij} > 0")
    sheet.wire((360, 310), (360, 170), (610, 170))
    sheet.resistor((610, 170), (830, 170), "P_{ij}$ if $P_{ij} > 0")
    sheet.text(
        (450, 655), "$P_{ij}$, $|P_{ij}|$ and $G_{i} = 1/R_{0} + Σ_{j≠i} |P_{ij}| − P_{ii}$ are conductances", "middle"
    )
    return sheet


def row(sheet, y, name, end, left=30):
    """A crossbar's row, from its free end to the amplifier."""
    sheet.wire((left, y), end)
    sheet.name((left, y), name, -6, 5, "end")


def column(sheet, x, top, bottom, name, y):
    """A crossbar's column; the label at height y."""
    sheet.wire((x, top), (x, bottom))
    sheet.name((x, top), name, 7, y - top)


def crossings(sheet, columns, y, labels):
    """Conductances from named columns to the row at y."""
    for name, label in labels.items():
        x = columns[name]
        sheet.resistor((x, y - 40), (x + 40, y), label)


def drawn_out(sheet, x, y, label):
    """A current out of the row at y."""
    sheet.current_source((x, y), (x, y + 90), label, -1)
    sheet.ground((x, y + 90))


def crossbar():
    """The crossbar with fully differential amplifiers

    Columns carry +f_j and -f_j, rows are the summing nodes s_i. A conductance |P_ij| joins row i to
    column +f_j where P_ij is positive and to -f_j where it is negative; a current b_i leaves each
    row, and amplifier i drives +f_i and -f_i.
    """
    sheet = Sheet(800, 570)
    f = {"+f_{0}": 70, "−f_{0}": 160, "+f_{1}": 250, "−f_{1}": 340}
    for k, y, pins, up in ((0, 170, "bottom", -1), (1, 340, "top", 1)):
        p, m, *outs = sheet.differential_amplifier((590, y + 20 * up), pins, pins)
        row(sheet, y, f"s_{{{k}}}", m)
        drawn_out(sheet, 450, y, f"b_{{{k}}}")
        sheet.grounded(p)
        for sign, out, x in zip("+−", outs, (750, 720)):
            name = f"{sign}f_{{{k}}}"
            level = 265 + (225 if sign == "+" else 205) * up
            sheet.wire(out, (x, out[1]), (x, level), (f[name], level))
            column(sheet, f[name], *((level, 400) if k == 0 else (80, level)), name, 98)
            sheet.text((out[0] + 4, out[1] + (-8 if out[1] == min(outs)[1] else 21)), f"${name}$")
    crossings(sheet, f, 170, {"+f_{0}": "P_{00}", "−f_{1}": "|P_{01}|"})
    crossings(sheet, f, 340, {"−f_{0}": "|P_{10}|", "+f_{1}": "P_{11}"})
    sheet.text((400, 545), "$|P_{ij}|$ are conductances;  here $P_{01} = P_{10} < 0$", "middle")
    return sheet


def crossbar_inverters():
    """The crossbar with inverters

    As the crossbar with fully differential amplifiers, but each row's operational amplifier gives
    f_i alone, and an inverter of two equal resistors R_0 gives -f_i.
    """
    sheet = Sheet(900, 590)
    f = {"−f_{0}": 60, "f_{0}": 150, "−f_{1}": 240, "f_{1}": 330}
    for k, y, level, outer in ((0, 180, 60, 40), (1, 380, 510, 530)):
        p, m = sheet.opamp((590, y + 20), "bottom")
        row(sheet, y, f"s_{{{k}}}", m)
        drawn_out(sheet, 440, y, f"b_{{{k}}}")
        sheet.grounded(p)
        name = f"f_{{{k}}}"
        sheet.wire((590, y + 20), (610, y + 20), (610, level), (f[name], level))
        sheet.text((617, level + (30 if k == 0 else -20)), f"${name}$")
        column(sheet, f[name], *((level, 440) if k == 0 else (90, level)), name, 108)
        # the inverter
        sheet.resistor((610, y + 20), (690, y + 20), "R_{0}")
        p, m = sheet.opamp((800, y + 40), "bottom")
        sheet.wire((690, y + 20), m)
        sheet.grounded(p)
        sheet.wire((690, y + 20), (690, y - 40))
        sheet.resistor((690, y - 40), (830, y - 40), "R_{0}")
        sheet.wire((830, y - 40), (830, y + 40))
        name = f"−f_{{{k}}}"
        sheet.wire((800, y + 40), (870, y + 40), (870, outer), (f[name], outer))
        sheet.text((862, level + (30 if k == 0 else -20)), f"${name}$", "end")
        column(sheet, f[name], *((outer, 440) if k == 0 else (90, outer)), name, 108)
    crossings(sheet, f, 180, {"f_{0}": "P_{00}", "−f_{1}": "|P_{01}|"})
    crossings(sheet, f, 380, {"−f_{0}": "|P_{10}|", "f_{1}": "P_{11}"})
    sheet.text((450, 570), "$|P_{ij}|$ are conductances;  here $P_{01} = P_{10} < 0$", "middle")
    return sheet


def output_columns(sheet, columns, outputs, k, turns, name_y, text_x):
    """The outputs of traction k's amplifier, + and −, each led to its column, whose name stands at height name_y."""
    for sign, out, (x, level), above in zip("+−", outputs, turns, (-8, 21)):
        name = f"{sign}f_{{{k}}}"
        sheet.wire(out, (x, out[1]), (x, level), (columns[name], level))
        column(sheet, columns[name], level, 60, name, name_y)
        sheet.text((text_x, out[1] + above), f"${name}$", "end")


def residual_amplifiers(sheet, f, e, bottom):
    """Two amplifiers that hold e = -rho (K f - g), from the columns of f to those of e, which lead down to `bottom`."""
    # to the columns of e without a crossing: the outputs further up turn down further right
    for k, y, turns in ((0, 130, ((640, 490), (620, 490))), (1, 310, ((600, 470), (580, 450)))):
        p, m, *outs = sheet.differential_amplifier((490, y + 20))
        row(sheet, y, f"u_{{{k}}}", m)
        drawn_out(sheet, 380, y, f"g_{{{k}}}")
        sheet.grounded(p)
        sheet.wire((420, y), (420, y - 60))
        sheet.resistor((420, y - 60), (550, y - 60), "1/ρ")
        sheet.wire((550, y - 60), (550, y))
        for sign, out, (x, level), above in zip("+−", outs, turns, (-8, 21)):
            name = f"{sign}e_{{{k}}}"
            sheet.wire(out, (x, out[1]), (x, level), (e[name], level), (e[name], 500))
            column(sheet, e[name], 500, bottom, name, 518)
            sheet.text((545, out[1] + above), f"${name}$", "end")
    crossings(sheet, f, 130, {"+f_{0}": "K_{00}", "−f_{1}": "|K_{01}|"})
    crossings(sheet, f, 310, {"−f_{0}": "|K_{10}|", "+f_{1}": "K_{11}"})


def least_squares():
    """Least squares in two crossbars

    Residual amplifiers (top) with feedback conductance 1/rho form e = -rho (K f - g) from the
    columns +f_j, -f_j and the currents g_i drawn out of their summing nodes. Main amplifiers
    (bottom) drive f so that -K' e + rho R f = 0, from the columns -e_i, +e_i and +f_k, -f_k.
    """
    sheet = Sheet(920, 940)
    f = {"+f_{0}": 50, "−f_{0}": 140, "+f_{1}": 230, "−f_{1}": 320}
    e = {"−e_{1}": 400, "+e_{1}": 480, "−e_{0}": 560, "+e_{0}": 640}
    residual_amplifiers(sheet, f, e, 750)
    # the tractions
    for k, y, turns in ((0, 590, ((890, 880), (870, 860))), (1, 710, ((850, 840), (830, 820)))):
        p, m, *outs = sheet.differential_amplifier((760, y + 20))
        row(sheet, y, f"s_{{{k}}}", m)
        sheet.grounded(p)
        output_columns(sheet, f, outs, k, turns, 518, 815)
    crossings(sheet, f, 590, {"+f_{0}": "ρR_{00}", "−f_{1}": "ρ|R_{01}|"})
    crossings(sheet, f, 710, {"−f_{0}": "ρ|R_{10}|", "+f_{1}": "ρR_{11}"})
    crossings(sheet, e, 590, {"−e_{0}": "K_{00}", "+e_{1}": "|K_{10}|"})
    crossings(sheet, e, 710, {"+e_{0}": "|K_{01}|", "−e_{1}": "K_{11}"})
    sheet.text(
        (460, 918), "Resistors are labelled with their conductances;  here $K_{01}, K_{10}, R_{01} < 0$", "middle"
    )
    return sheet


def least_squares_ladder():
    """Least squares with a ladder

    As least squares in two crossbars, but the columns +f_j, -f_j are nodes that nothing drives: from the
    outputs +y_j, -y_j of the main amplifiers conductances z lead to them, a between neighbours and g to
    ground. A main row meets the columns of e and, through rho d, its own output y.
    """
    sheet = Sheet(920, 1080)
    f = {"+f_{0}": 50, "+f_{1}": 140, "−f_{0}": 230, "−f_{1}": 320}
    e = {"−e_{1}": 430, "+e_{1}": 500, "−e_{0}": 570, "+e_{0}": 640}
    levels = {"+f_{0}": 1010, "+f_{1}": 965, "−f_{0}": 920, "−f_{1}": 875}
    residual_amplifiers(sheet, f, e, 810)
    # the main amplifiers, and what they feed
    for k, y, turns in ((0, 590, (905, 885)), (1, 770, (865, 845))):
        p, m, *outs = sheet.differential_amplifier((775, y + 20))
        row(sheet, y, f"s_{{{k}}}", m, 400)
        sheet.grounded(p)
        sheet.wire((705, y), (705, y - 60))
        sheet.resistor((705, y - 60), (835, y - 60), "ρd")
        sheet.wire((835, y - 60), (835, y))
        for sign, out, x, above in zip("+−", outs, turns, (-8, 21)):
            name = f"{sign}f_{{{k}}}"
            level, at = levels[name], f[name]
            sheet.wire(out, (x, out[1]), (x, level), (at + 80, level))
            sheet.resistor((at + 80, level), (at, level), "z")
            column(sheet, at, level, 60, name, 518)
            sheet.name((740, level), f"{sign}y_{{{k}}}", 0, -7)
            sheet.wire((at, 620), (at + 35, 620))
            sheet.resistor((at + 35, 620), (at + 35, 700), f"g_{{{k}}}^{{{sign}}}")
            sheet.ground((at + 35, 700))
    for sign in "+−":
        sheet.resistor((f[f"{sign}f_{{0}}"], 440), (f[f"{sign}f_{{1}}"], 440), "a")
    crossings(sheet, e, 590, {"−e_{0}": "K_{00}", "+e_{1}": "|K_{10}|"})
    crossings(sheet, e, 770, {"+e_{0}": "|K_{01}|", "−e_{1}": "K_{11}"})
    sheet.text((460, 1058), "Resistors are labelled with their conductances;  here $K_{01}, K_{10} < 0$", "middle")
    return sheet


def lattice():
    """Least squares with passive residuals

    A reading's residual is a pair of nodes u+, u- that nothing drives (top): conductances A lead to
    them from the columns +f_j, -f_j, and currents g go out of u+ and into u-. Conductances B lead on
    from u+ and u- to both inputs of the differential amplifiers (bottom), which the stabiliser's
    conductances reach from the columns. Signs are made by crossing the pairs.
    """
    sheet = Sheet(920, 920)
    f = {"+f_{0}": 60, "−f_{0}": 150, "+f_{1}": 240, "−f_{1}": 330}
    u = {"u_{0}^{+}": 480, "u_{0}^{−}": 570}
    for (name, x), y, a, b in zip(u.items(), (130, 250), (0, 1), (1, 0)):
        row(sheet, y, name, (x, y), 40)
        sheet.wire((x, y), (x, 810))
        low, high = (410, y), (410, y + 80)
        sheet.current_source((low, high)[a], (low, high)[b], "g_{0}", -1)
        sheet.ground(high)
    crossings(sheet, f, 130, {"+f_{0}": "a K_{00}", "−f_{1}": "a|K_{01}|"})
    crossings(sheet, f, 250, {"−f_{0}": "a K_{00}", "+f_{1}": "a|K_{01}|"})
    # the tractions: both inputs are rows
    for k, y, turns in ((0, 420, ((890, 880), (870, 860))), (1, 660, ((850, 840), (830, 820)))):
        p, m, *outs = sheet.differential_amplifier((740, y + 60), "bottom")
        row(sheet, y, f"s_{{{k}}}^{{+}}", (650, y), 40)
        row(sheet, y + 120, f"s_{{{k}}}^{{−}}", (650, y + 120), 40)
        sheet.wire((650, y), (650, p[1]), p)
        sheet.wire((650, y + 120), (650, m[1]), m)
        output_columns(sheet, f, outs, k, turns, 340, 797)
    crossings(sheet, f, 420, {"−f_{0}": "R_{00}", "+f_{1}": "|R_{01}|"})
    crossings(sheet, f, 540, {"+f_{0}": "R_{00}", "−f_{1}": "|R_{01}|"})
    crossings(sheet, f, 660, {"+f_{0}": "|R_{10}|", "−f_{1}": "R_{11}"})
    crossings(sheet, f, 780, {"−f_{0}": "|R_{10}|", "+f_{1}": "R_{11}"})
    crossings(sheet, u, 420, {"u_{0}^{−}": "b K_{00}"})
    crossings(sheet, u, 540, {"u_{0}^{+}": "b K_{00}"})
    crossings(sheet, u, 660, {"u_{0}^{+}": "b|K_{01}|"})
    crossings(sheet, u, 780, {"u_{0}^{−}": "b|K_{01}|"})
    sheet.text((460, 908), "Resistors are labelled with their conductances;  here $K_{01}, R_{01} < 0$", "middle")
    return sheet


def lc():
    """The network of capacitors and inductors

    At one frequency omega, capacitors -P_ij / omega stand for the positive conductances, turned by
    90 degrees, inductors for the negative ones; the current sources are turned too, so the node
    voltages solve P f = b.
    """
    sheet = Sheet(720, 390)
    branches, grounds = ["C_{01}", "C_{12}", "L_{02}"], ["C_{0}", "C_{1}", "C_{2}"]
    sources = ["jb_{0}", "jb_{1}", "jb_{2}"]
    three_nodes(sheet, 110, 250, 130, sheet.capacitor, sheet.inductor, branches, grounds, sources)
    sheet.text((360, 335), "$C_{ij} = −P_{ij}/ω$,   $L_{02} = 1/(ωP_{02})$,   $C_{i} = g_{i}/ω$", "middle")
    sheet.text(
        (360, 365), "AC at angular frequency $ω$; currents as phasors; the voltage of $n_{i}$ is $f_{i}$", "middle"
    )
    return sheet


def curve(sheet, style, function, span, origin, scale, low, high):
    """i = function(v) where low <= i <= high."""
    points = []
    for step in range(201):
        v = span[0] + (span[1] - span[0]) * step / 200
        i = function(v)
        if low <= i <= high:
            points.append(f"{number(origin[0] + scale[0] * v)} {number(origin[1] - scale[1] * i)}")
    sheet.bodies.append(f'<path class="{style}" d="M{" L".join(points)}"/>')


def ndr():
    """The network with N-shaped devices

    Negative branches are two-terminal devices whose current falls with rising voltage around 0:
    left the network, right the current of a cubic device and of a tunnel diode biased at its
    steepest point, both with slope -g at 0.
    """
    sheet = Sheet(900, 420)
    branches, grounds = ["−P_{01}", "−P_{12}", "g = P_{02}"], ["g_{0}", "g_{1}", "g_{2}"]
    three_nodes(sheet, 90, 170, 140, sheet.resistor, sheet.n_device, branches, grounds, ["b_{0}", "b_{1}", "b_{2}"])

    (x, y), (sx, sy) = origin, scale = (710, 140), (55, 70)
    left, right, low, high = -2.2, 3.2, -2.0, 1.4
    x0, x1, y0, y1 = (number(value) for value in (x + left * sx, x + right * sx, y - low * sy, y - high * sy))
    axes = f"M{x0} {y} H{x1} M{x} {y0} V{y1} M{x0} {y0} H{x1} V{y1} H{x0} Z"
    for tick in range(-2, 4):
        axes += f" M{x + tick * sx} {y0} v-5"
        sheet.text((x + tick * sx, y - low * sy + 18), f"{tick}".replace("-", "−"), "middle", 13)
    for tick in range(-2, 2):
        axes += f" M{x0} {y - tick * sy} h5"
        sheet.text((x + left * sx - 8, y - tick * sy + 5), f"{tick}".replace("-", "−"), "end", 13)
    sheet.bodies.append(f'<path class="fine" d="{axes}"/>')
    sheet.text((x + (left + right) / 2 * sx, y - low * sy + 40), "$v/V$", "middle")
    sheet.text((x + left * sx, y - high * sy - 10), "$i/(gV)$")
    curve(sheet, "tangent", lambda v: -v, (-1.25, 1.25), origin, scale, low, high)
    curve(sheet, "first", lambda v: -v * (1 - v * v / 3), (left, right), origin, scale, low, high)
    curve(sheet, "second", lambda v: (2 + v) * math.exp(-v) - 2, (left, right), origin, scale, low, high)
    sheet.text((x - 1.2 * sx, y - 1.2 * sy + 18), "$−gv$", "end")

    sheet.bodies.append('<path class="first" d="M40 365 h36"/><path class="second" d="M40 397 h36"/>')
    sheet.text((88, 370), "cubic:  $i = −gv (1 − (v/V_{s})^{2})$,  drawn for $V_{s} = √3 V$")
    sheet.text((88, 402), "tunnel diode, biased at its steepest point:  $i = gV ((2 + u) e^{−u} − 2)$,  $u = v/V$")
    return sheet


# A picture's docstring is its title and its description.
PICTURES = {
    "ideal": ideal,
    "nic": nic,
    "rail": rail,
    "crossbar": crossbar,
    "crossbar-inverters": crossbar_inverters,
    "least_squares": least_squares,
    "least_squares-ladder": least_squares_ladder,
    "lattice": lattice,
    "lc": lc,
    "ndr": ndr,
}

if __name__ == "__main__":
    folder = pathlib.Path(__file__).resolve().parents[2] / "circuits"
    folder.mkdir(parents=True, exist_ok=True)
    for name, picture in PICTURES.items():
        title, description = (" ".join(part.split()) for part in picture.__doc__.split("\n\n"))
        svg = picture().svg(title, description)
        (folder / f"{name}.svg").write_text(svg, encoding="utf-8", newline="\n")

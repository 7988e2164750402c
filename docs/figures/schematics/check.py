#!/usr/bin/env python3
"""Solves the circuits as drawn: `python3 docs/figures/schematics/check.py` says for each how far it is from P f = b."""

from draw import PICTURES
from symbols import on


def solve(matrix, right):
    """Gaussian elimination."""
    rows = [row[:] + [value] for row, value in zip(matrix, right)]
    for c in range(len(rows)):
        pivot = max(range(c, len(rows)), key=lambda r: abs(rows[r][c]))
        rows[c], rows[pivot] = rows[pivot], rows[c]
        for r in range(len(rows)):
            if r != c:
                factor = rows[r][c] / rows[c][c]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[c])]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def free_ends(sheet):
    """Ends of wires that meet neither a wire nor a symbol."""
    pins = {pin for _, ends, _ in sheet.parts for pin in ends}
    return sorted(point for wire in sheet.wires for point in wire if sheet.arms(point) == 1 and point not in pins)


class Netlist:
    """The circuit that a sheet's wires connect. `values` gives each label's conductance or current."""

    def __init__(self, sheet, values):
        self.sheet, self.group = sheet, list(range(len(sheet.wires)))
        for i, wire in enumerate(sheet.wires):
            for j, other in enumerate(sheet.wires):
                if any(on(end, other) for end in wire):
                    old, new = self.group[i], self.group[j]
                    self.group = [new if g == old else g for g in self.group]
        self.ground = {self.net(ends[0]) for kind, ends, _ in sheet.parts if kind == "ground"}
        self.nets = sorted(set(self.group) - self.ground)
        self.conductances, self.sources, self.amplifiers, self.ports = [], [], [], []
        for kind, ends, label in sheet.parts:
            nodes = [self.node(end) for end in ends]
            if kind == "port":
                self.ports.append((label, nodes[0]))
            elif kind == "source":
                self.sources.append((*nodes, values[label]))
            elif kind in ("opamp", "differential"):
                self.amplifiers.append((nodes[0], nodes[1], list(zip(nodes[2:], (1, -1)))))
            elif kind != "ground":
                self.conductances.append((*nodes, values[label]))

    def net(self, point):
        return next(group for group, wire in zip(self.group, self.sheet.wires) if on(point, wire))

    def node(self, point):
        """Ground is the last node."""
        net = self.net(point)
        return len(self.nets) if net in self.ground else self.nets.index(net)

    def response(self, state, driven):
        """Voltages of all nodes, then the current into each driven one, with the amplifiers' outputs at +-state."""
        fixed = [(node, sign * x) for (_, _, outs), x in zip(self.amplifiers, state) for node, sign in outs] + driven
        ground, size = len(self.nets), len(self.nets) + 1 + len(fixed)
        matrix, right = [[0.0] * (size + 1) for _ in range(size + 1)], [0.0] * (size + 1)
        for a, b, conductance in self.conductances:
            for here, there in ((a, b), (b, a)):
                matrix[here][here] += conductance
                matrix[here][there] -= conductance
        for a, b, current in self.sources:
            right[a] -= current
            right[b] += current
        for k, (node, voltage) in enumerate([(ground, 0.0)] + fixed, ground + 1):
            matrix[k][node], matrix[node][k], right[k] = 1.0, -1.0, voltage
        answer = solve(matrix, right)
        return answer[: ground + 1], answer[len(answer) - len(driven) :]

    def settle(self, driven=()):
        """Each amplifier integrates the voltage between its + and - inputs, so a wrong polarity runs away."""

        def slopes(state):
            voltages, _ = self.response(state, list(driven))
            return [voltages[plus] - voltages[minus] for plus, minus, _ in self.amplifiers]

        size = len(self.amplifiers)
        start = slopes([0.0] * size)
        columns = [[a - b for a, b in zip(slopes([float(i == k) for i in range(size)]), start)] for k in range(size)]
        state = [0.0] * size
        for _ in range(5000):
            slope = [start[i] + sum(columns[k][i] * state[k] for k in range(size)) for i in range(size)]
            state = [x + 0.2 * dx for x, dx in zip(state, slope)]
            assert all(abs(x) < 1e6 for x in state), "unstable"
        return self.response(state, list(driven))

    def voltages(self, labels):
        voltages, _ = self.settle()
        return [voltages[self.node(dict(self.sheet.names)[label])] for label in labels]


B = [0.7, -0.4, 1.1]
P = [[1.0, -0.3, 0.2], [-0.3, 1.2, -0.25], [0.2, -0.25, 0.9]]


def three_nodes(sheet):
    values = {"−P_{01}": 0.3, "−P_{12}": 0.25, "−P_{02} < 0": -0.2, "g = P_{02}": -0.2}
    values |= {"C_{01}": 0.3, "C_{12}": 0.25, "L_{02}": -0.2}
    for k in range(3):
        values |= {f"b_{{{k}}}": B[k], f"jb_{{{k}}}": B[k], f"g_{{{k}}}": sum(P[k]), f"C_{{{k}}}": sum(P[k])}
    return Netlist(sheet, values).voltages(["n_{0}", "n_{1}", "n_{2}"]), solve(P, B)


def nic(sheet):
    g, v = 0.37, {"n_{i}": 0.8, "n_{j}": -0.3}
    netlist = Netlist(sheet, {"1/G": g, "R": 5.0, "−G": -g})
    voltages, currents = netlist.settle([(node, v[label]) for label, node in netlist.ports])
    vi, vj = v.values()
    means = {"2v_{i} − v_{j}": 2 * vi - vj, "2v_{j} − v_{i}": 2 * vj - vi, "2v_{i}": 2 * vi, "v_{i}": vi, "v_{j}": vj}
    taps = [(voltages[netlist.node(at)], means[label.split(" = ")[1]]) for label, at in sheet.names if " = " in label]
    floating, grounded = [-g * (vi - vj), -g * (vj - vi)] * 2, [-g * vi] * 2
    return currents + [tap for tap, _ in taps], floating + grounded + [expected for _, expected in taps]


def rail(sheet, coupling):
    p, r0 = [[0.35, coupling], [coupling, 0.45]], 5.0
    values = {"R": 1.0, "R_{0}": 1 / r0, "b_{i}": B[0], "b_{j}": B[1]}
    values |= {"|P_{ij}|$ if $P_{ij} < 0": max(-coupling, 0.0), "P_{ij}$ if $P_{ij} > 0": max(coupling, 0.0)}
    values |= {f"1/G_{{{k}}}": 1 / r0 + abs(coupling) - p[i][i] for i, k in enumerate("ij")}
    f = solve(p, B[:2])
    labels = ["n_{i}", "n_{j}", "r_{i} = −v_{i}", "r_{j} = −v_{j}"]
    return Netlist(sheet, values).voltages(labels), f + [-x for x in f]


def crossbar(sheet, plus):
    p = [[0.9, -0.4], [-0.25, 0.7]]
    values = {
        "P_{00}": 0.9,
        "|P_{01}|": 0.4,
        "|P_{10}|": 0.25,
        "P_{11}": 0.7,
        "R_{0}": 2.0,
        "b_{0}": B[0],
        "b_{1}": B[1],
    }
    f = solve(p, B[:2])
    labels = [sign + name for sign in (plus, "−") for name in ("f_{0}", "f_{1}")] + ["s_{0}", "s_{1}"]
    return Netlist(sheet, values).voltages(labels), f + [-x for x in f] + [0.0, 0.0]


def least_squares(sheet):
    k, r, rho, g = [[1.0, -0.4], [-0.3, 0.8]], [[0.2, -0.05], [-0.07, 0.3]], 2.5, B[:2]
    values = {"1/ρ": 1 / rho, "g_{0}": g[0], "g_{1}": g[1]}
    values |= {"K_{00}": 1.0, "|K_{01}|": 0.4, "|K_{10}|": 0.3, "K_{11}": 0.8}
    values |= {"ρR_{00}": rho * 0.2, "ρ|R_{01}|": rho * 0.05, "ρ|R_{10}|": rho * 0.07, "ρR_{11}": rho * 0.3}
    p = [[sum(k[i][a] * k[i][b] for i in (0, 1)) + r[a][b] for b in (0, 1)] for a in (0, 1)]
    f = solve(p, [sum(k[i][a] * g[i] for i in (0, 1)) for a in (0, 1)])
    e = [-rho * (sum(k[i][a] * f[a] for a in (0, 1)) - g[i]) for i in (0, 1)]
    labels = [f"{sign}{name}_{{{i}}}" for name in "fe" for sign in "+−" for i in (0, 1)]
    return Netlist(sheet, values).voltages(labels), f + [-x for x in f] + e + [-x for x in e]


def least_squares_ladder(sheet):
    k, rho, d, z, a, g = [[1.0, -0.4], [-0.3, 0.8]], 2.5, 0.1, 1.5, 0.7, B[:2]
    to_ground = [1.6, 1.4]  # of each f, K's own load in it
    values = {"1/ρ": 1 / rho, "ρd": rho * d, "z": z, "a": a, "g_{0}": g[0], "g_{1}": g[1]}
    values |= {"K_{00}": 1.0, "|K_{01}|": 0.4, "|K_{10}|": 0.3, "K_{11}": 0.8}
    values |= {"g_{0}^{+}": to_ground[0] - 1.0, "g_{0}^{−}": to_ground[0] - 0.3}
    values |= {"g_{1}^{+}": to_ground[1] - 0.8, "g_{1}^{−}": to_ground[1] - 0.4}
    r = [[d / z * (z + to_ground[i] + a if i == j else -a) for j in (0, 1)] for i in (0, 1)]
    p = [[sum(k[i][m] * k[i][n] for i in (0, 1)) + r[m][n] for n in (0, 1)] for m in (0, 1)]
    f = solve(p, [sum(k[i][m] * g[i] for i in (0, 1)) for m in (0, 1)])
    e = [-rho * (sum(k[i][m] * f[m] for m in (0, 1)) - g[i]) for i in (0, 1)]
    y = [sum(r[i][j] * f[j] for j in (0, 1)) / d for i in (0, 1)]
    labels = [f"{sign}{name}_{{{i}}}" for name in "fey" for sign in "+−" for i in (0, 1)]
    return Netlist(sheet, values).voltages(labels), [s * x for v in (f, e, y) for s in (1, -1) for x in v]


def lattice(sheet):
    k, r, a, b, g = [1.0, -0.4], [[0.2, -0.05], [-0.05, 0.3]], 2.0, 0.5, 1.4
    total = (a + b) * (abs(k[0]) + abs(k[1]))
    values = {"g_{0}": a * g, "a K_{00}": a * k[0], "a|K_{01}|": -a * k[1], "b K_{00}": b * k[0], "b|K_{01}|": -b * k[1]}
    values |= {"R_{00}": 0.2, "|R_{01}|": 0.05, "|R_{10}|": 0.05, "R_{11}": 0.3}
    weight = a * b / total
    p = [[weight * k[i] * k[j] + r[i][j] for j in (0, 1)] for i in (0, 1)]
    f = solve(p, [weight * k[i] * g for i in (0, 1)])
    u = a * (k[0] * f[0] + k[1] * f[1] - g) / total
    labels = [f"{sign}f_{{{i}}}" for sign in "+−" for i in (0, 1)] + ["u_{0}^{+}", "u_{0}^{−}"]
    return Netlist(sheet, values).voltages(labels), f + [-x for x in f] + [u, -u]


CHECKS = {
    "ideal": three_nodes,
    "nic": nic,
    "rail": lambda sheet: [a + b for a, b in zip(rail(sheet, 0.3), rail(sheet, -0.3))],
    "crossbar": lambda sheet: crossbar(sheet, "+"),
    "crossbar-inverters": lambda sheet: crossbar(sheet, ""),
    "least_squares": least_squares,
    "least_squares-ladder": least_squares_ladder,
    "lattice": lattice,
    "lc": three_nodes,
    "ndr": three_nodes,
}
# Free ends of rows and columns
OPEN = {"crossbar": 6, "crossbar-inverters": 6, "least_squares": 12, "least_squares-ladder": 12, "lattice": 12}

if __name__ == "__main__":
    for name, picture in PICTURES.items():
        sheet = picture()
        assert len(free_ends(sheet)) == OPEN.get(name, 0), (name, free_ends(sheet))
        found, expected = CHECKS[name](sheet)
        error = max(abs(a - b) for a, b in zip(found, expected, strict=True))
        print(f"{name}: {len(found)} voltages and currents, largest difference {error:.0e}")
        assert error < 1e-9, name

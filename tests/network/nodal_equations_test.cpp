#include "network/nodal_equations.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <stdexcept>

#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// From 0 to 1.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : generator_(seed) {}
  double operator()() { return static_cast<double>(generator_()) / 4294967296.0; }
  double spread(double centre) { return centre * std::pow(10.0, 2.0 * (*this)() - 1.0); }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>((*this)() * static_cast<double>(count));
  }

 private:
  std::mt19937 generator_;
};

/// Nodes, each with a resistor to ground and to the one before.
Circuit resistors_on(std::size_t nodes, Numbers& number) {
  Circuit circuit;
  for (Node node = 1; node <= nodes; ++node) {
    add_node(circuit, "n" + std::to_string(node));
    circuit.resistors.push_back({"Rg", node, 0, number.spread(1e-3)});
    circuit.resistors.push_back({"Rb", node, node - 1, number.spread(1e-3)});
    circuit.outputs.push_back(node);
  }
  return circuit;
}

/// The circuit's finite poles, slowest first, of G and C with an unknown for every node's voltage,
/// every op-amp's core and every output's current: p = -1 / mu, mu the eigenvalues of G^-1 C.
std::vector<std::complex<double>> all_poles(const Circuit& circuit, std::size_t finite) {
  const auto nodes = static_cast<Eigen::Index>(circuit.nodes.size());
  const auto amplifiers = static_cast<Eigen::Index>(circuit.instances.size());
  const Eigen::Index size = nodes + 2 * amplifiers;
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd c = g;
  const auto part = [](Eigen::MatrixXd& to, Node from, Node at, double value) {
    const auto a = static_cast<Eigen::Index>(from);
    const auto b = static_cast<Eigen::Index>(at);
    to(a, a) += value;
    to(b, b) += value;
    to(a, b) -= value;
    to(b, a) -= value;
  };
  for (const Resistor& r : circuit.resistors) part(g, r.from, r.to, r.siemens);
  for (const Capacitor& one : circuit.capacitors) part(c, one.from, one.to, one.farad);
  for (Eigen::Index k = 0; k < amplifiers; ++k) {
    const Instance& x = circuit.instances[static_cast<std::size_t>(k)];
    const auto pin = [&](std::size_t at) { return static_cast<Eigen::Index>(x.pins[at]); };
    const OpAmp& opamp = amplifier(circuit, x.subcircuit)->opamp;
    const Eigen::Index core = nodes + 2 * k;
    g(core, pin(0)) -= 1.0;
    g(core, pin(1)) += 1.0;
    g(core, core) = 1.0 / *opamp.gain;
    c(core, core) = 0.5 / (3.14159265358979323846 * *opamp.bandwidth);
    g(pin(2), core + 1) = -1.0;
    g(core + 1, pin(2)) = 1.0;
    g(core + 1, core) = -1.0;
  }
  const Eigen::MatrixXd grounded = g.bottomRightCorner(size - 1, size - 1)
                                       .fullPivLu()
                                       .solve(c.bottomRightCorner(size - 1, size - 1));
  const Eigen::VectorXcd mu = grounded.eigenvalues();
  std::vector<std::complex<double>> poles;
  for (const std::complex<double>& one : mu) poles.push_back(-1.0 / one);
  std::sort(poles.begin(), poles.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  poles.resize(finite);
  return poles;
}

void check_poles(const Circuit& circuit, double relative) {
  std::vector<std::complex<double>> own = poles(state_space(circuit));
  for (const std::complex<double>& expected : all_poles(circuit, own.size())) {
    const auto nearest =
        std::min_element(own.begin(), own.end(), [&](const auto& a, const auto& b) {
          return std::abs(a - expected) < std::abs(b - expected);
        });
    CAPTURE(expected, *nearest);
    CHECK(std::abs(*nearest - expected) < relative * std::abs(expected));
    own.erase(nearest);
  }
}

/// An amplifier whose summing node takes a resistor from its output: a crossbar of one node.
Circuit one_amplifier(const OpAmp& opamp, Outputs outputs = Outputs::single) {
  Circuit circuit;
  circuit.amplifiers = {{"amplifier", opamp, outputs}};
  const Node s = add_node(circuit, "s0");
  const Node n = add_node(circuit, "n0");
  circuit.outputs = {n};
  circuit.instances = {{"X0", {0, s, n}, "amplifier"}};
  if (outputs == Outputs::complementary)
    circuit.instances[0].pins.push_back(add_node(circuit, "r0"));
  circuit.resistors = {{"R0", n, s, 1e-3}};
  circuit.sources = {{"I0", s, -1e-3}};
  return circuit;
}

/// The poles' sum and product: a quadratic's coefficients.
void check_pair(const Circuit& circuit, double sum, double product) {
  const std::vector<std::complex<double>> own = poles(state_space(circuit));
  REQUIRE(own.size() == 2);
  CHECK_THAT((own[0] + own[1]).real(), WithinRel(sum, 1e-6));
  CHECK_THAT((own[0] * own[1]).real(), WithinRel(product, 1e-6));
}

}  // namespace

TEST_CASE("a passive network is reciprocal", "[nodal][property]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Numbers number(seed);
    Circuit circuit = resistors_on(9, number);
    for (int more = 0; more < 12; ++more)
      circuit.resistors.push_back({"R", number.below(10), number.below(10), number.spread(1e-3)});
    const FlatCircuit flat(circuit);
    const NodalEquations equations(flat);
    const auto at = [&](Node node) {
      return equations.outputs(std::vector<CurrentSource>{{"I", node, 1.0}});
    };
    for (Node a = 1; a <= 9; ++a)
      for (Node b = 1; b < a; ++b)
        CHECK_THAT(at(a)(static_cast<Eigen::Index>(b) - 1),
                   WithinRel(at(b)(static_cast<Eigen::Index>(a) - 1), 1e-12));
  }
}

TEST_CASE("currents sum to 0 at every node, and op-amps hold their laws", "[nodal][property]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice})
    for (const unsigned set : {0U, 0x7FFU, 0x200U, 0x143U}) {
      CAPTURE(name(one), set);
      OpAmp opamp = opamp_with(set);
      opamp.gain = 1e3;
      const FlatCircuit flat(realize(one, network.problem, {.opamp = opamp}));
      const Circuit& circuit = flat.circuit();
      const Eigen::VectorXd v = NodalEquations(flat).voltages();
      const auto volts = [&](Node node) { return v(static_cast<Eigen::Index>(node)); };
      std::vector<double> leaving(circuit.nodes.size());
      for (const Resistor& r : circuit.resistors) {
        leaving[r.from] += r.siemens * (volts(r.from) - volts(r.to));
        leaving[r.to] -= r.siemens * (volts(r.from) - volts(r.to));
      }
      for (const CurrentSource& i : circuit.sources) leaving[i.into] -= i.ampere;
      std::vector<bool> held(circuit.nodes.size());
      held[0] = true;
      const double bias = opamp.bias_current.value_or(0.0);
      const double common = 0.5 / opamp.common_mode_rejection.value_or(infinity);
      for (const FlatCircuit::Amplifier& x : flat.amplifiers()) {
        for (const Node input : {x.plus, x.minus}) leaving[input] += bias;
        held[x.out] = held[x.inverse] = true;
      }
      for (const FlatCircuit::Amplifier& x : flat.amplifiers()) {
        const double core = 1e3 * (volts(x.plus) - volts(x.minus) + opamp.offset.value_or(0.0) +
                                   common * (volts(x.plus) + volts(x.minus)));
        const double given =
            x.inverse != 0 ? 0.5 * (leaving[x.out] - leaving[x.inverse]) : leaving[x.out];
        CHECK_THAT(volts(x.out),
                   WithinAbs(core - opamp.output_resistance.value_or(0.0) * given, 1e-10));
        if (x.inverse != 0) CHECK(volts(x.inverse) == -volts(x.out));
      }
      for (Node node = 1; node < held.size(); ++node)
        if (!held[node]) CHECK_THAT(leaving[node], WithinAbs(0.0, 1e-14));
    }
}

TEST_CASE("adjoint sensitivities are what a small change of each makes", "[nodal][property]") {
  OpAmp opamp = opamp_with(0x7FF);
  opamp.gain = 1e4;
  const ArrayNetwork network = array_network(5, 1e-3);
  for (const Realization one : {Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const auto flat_with = [&](const OpAmp& own) {
      return FlatCircuit(realize(one, network.problem, {.opamp = own}));
    };
    const auto moved_by = [&](std::optional<double> OpAmp::*key, double step) -> Eigen::VectorXd {
      OpAmp other = opamp;
      other.*key = *(opamp.*key) + step;
      const FlatCircuit before = flat_with(opamp), after = flat_with(other);
      return NodalEquations(after).outputs() - NodalEquations(before).outputs();
    };
    const FlatCircuit flat = flat_with(opamp);
    const NodalEquations equations(flat);
    const Eigen::VectorXd offsets = 1e-3 * equations.by_offset().rowwise().sum();
    CHECK((moved_by(&OpAmp::offset, 1e-3) - offsets).norm() < 1e-9 * offsets.norm());
    // Of two inputs alike that float little is left.
    const Eigen::VectorXd bias = 2e-7 * equations.by_bias_current().rowwise().sum();
    CHECK((moved_by(&OpAmp::bias_current, 2e-7) - bias).norm() < 1e-9 * bias.norm() + 1e-13);
    CHECK(bias.norm() > (one == Realization::lattice ? 1e-11 : 1e-5));
  }
}

TEST_CASE("with its gain an op-amp comes to a nullor as 1 / gain", "[nodal][property]") {
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const ArrayNetwork network = array_network(5, 1e-3);
    const FlatCircuit flat(realize(one, network.problem));
    const Eigen::VectorXd ideal = NodalEquations(flat).outputs();
    for (std::size_t i = 0; i < network.direct.size(); ++i)
      CHECK_THAT(ideal(static_cast<Eigen::Index>(i)), WithinAbs(network.direct[i], 1e-11));
    const auto off = [&](double gain) {
      return (NodalEquations(flat, [&](OpAmp) { return OpAmp{.gain = gain}; }).outputs() - ideal)
          .norm();
    };
    CHECK(off(1e7) > 0.0);
    CHECK_THAT(off(1e7) / off(1e8), WithinRel(10.0, 1e-3));
  }
}

TEST_CASE("a capacitor between two nodes has the pole of both their resistors", "[nodal]") {
  // Neither node has a way to ground but by its resistor: -1 / (C (R1 + R2)).
  Circuit circuit;
  const Node a = add_node(circuit, "a");
  const Node b = add_node(circuit, "b");
  circuit.outputs = {a, b};
  circuit.resistors = {{"R1", a, 0, 1e-3}, {"R2", b, 0, 0.5e-3}};
  circuit.capacitors = {{"C0", a, b, 1e-9}};
  circuit.sources = {{"I0", a, 1e-3}};
  const StateSpace system = state_space(circuit);
  REQUIRE(system.states() == 1);
  CHECK_THAT(poles(system).front().real(), WithinRel(-1.0 / (1e-9 * 3e3), 1e-12));
  // At once both share the current, at the end none flows through the capacitor.
  CHECK_THAT(system.direct[0], WithinRel(1e-3 / 1.5e-3, 1e-12));
  CHECK_THAT(system.direct[1], WithinRel(1e-3 / 1.5e-3, 1e-12));
  CHECK_THAT(steady_state(system)[0], WithinRel(1.0, 1e-12));
  CHECK_THAT(steady_state(system)[1], WithinAbs(0.0, 1e-12));
  CHECK_THROWS_AS(output_noise(circuit), std::domain_error);  // white noise at both nodes
}

TEST_CASE("capacitors in equilibrium have k T C^-1, whatever the resistors", "[nodal][property]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    Numbers number(seed);
    Circuit circuit = resistors_on(8, number);  // half of its nodes without capacitance
    circuit.outputs.resize(4);
    Eigen::Matrix4d capacitance = Eigen::Matrix4d::Zero();
    for (const Node node : circuit.outputs)
      for (Node other = 0; other < node; ++other) {
        const double farad = number.spread(1e-9);
        circuit.capacitors.push_back({"C", node, other, farad});
        Eigen::Vector4d between = Eigen::Vector4d::Unit(static_cast<Eigen::Index>(node) - 1);
        if (other > 0) between -= Eigen::Vector4d::Unit(static_cast<Eigen::Index>(other) - 1);
        capacitance += farad * between * between.transpose();
      }
    const Eigen::Matrix4d expected = 1.380649e-23 * 300.15 * capacitance.inverse();
    const Eigen::Matrix4d seen = view(output_noise(circuit).thermal);
    CHECK((seen - expected).norm() < 1e-9 * expected.norm());
  }
}

TEST_CASE("capacitors anywhere between resistors have the poles of G and C", "[nodal][property]") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Numbers number(seed);
    Circuit circuit = resistors_on(8, number);
    // Loops, groups without a way to ground, and both of two parallel ones among them.
    circuit.capacitors = {{"C", 1, 2, number.spread(1e-9)}};
    const std::size_t count = number.below(9);
    for (std::size_t k = 0; k < count; ++k) {
      const Node from = 1 + number.below(8);
      circuit.capacitors.push_back(
          {"C", from, seed % 3 == 0 ? number.below(9) : 1 + number.below(8), number.spread(1e-9)});
    }
    check_poles(circuit, 1e-9);
    circuit.sources = {{"I0", 3, 1e-3}};
    const std::vector<double> rest = steady_state(state_space(circuit));
    const FlatCircuit flat(circuit);
    const Eigen::VectorXd expected = NodalEquations(flat).outputs();
    for (std::size_t i = 0; i < rest.size(); ++i)
      CHECK_THAT(rest[i], WithinAbs(expected(static_cast<Eigen::Index>(i)), 1e-12));
  }
}

TEST_CASE("capacitors anywhere beside op-amps have the poles of G and C", "[nodal][property]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Numbers number(seed);
    Circuit circuit = resistors_on(7, number);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string kind = "amplifier" + std::to_string(k);
      circuit.amplifiers.push_back(
          {kind, {.gain = 1e5, .bandwidth = number.spread(1e6)}, Outputs::single});
      const Node out = add_node(circuit, "out" + std::to_string(k));
      circuit.instances.push_back({"X" + std::to_string(k), {0, 1 + 3 * k, out}, kind});
      circuit.resistors.push_back({"Rf", out, 1 + 3 * k, number.spread(1e-3)});
      circuit.resistors.push_back({"Ro", out, 3 + k, number.spread(1e-3)});
    }
    for (int k = 0; k < 6; ++k)
      circuit.capacitors.push_back(
          {"C", 1 + number.below(9), number.below(10), number.spread(1e-10)});
    check_poles(circuit, 1e-6);
  }
}

TEST_CASE("a capacitor around an amplifier sets its pole", "[nodal]") {
  // (g + p C) (1 + p / W) v = -i at infinite gain.
  Circuit circuit = one_amplifier({.gain = 1e12, .bandwidth = bandwidth});
  circuit.capacitors = {{"C0", circuit.outputs[0], circuit.instances[0].pins[1], 1e-9}};
  const double slow = 1e-3 / 1e-9;
  check_pair(circuit, -slow - angular_bandwidth, slow * angular_bandwidth);
}

TEST_CASE("a load is nothing to an ideal output, and a pole behind a resistance", "[nodal]") {
  OpAmp opamp{.gain = 1e12, .bandwidth = bandwidth};
  Circuit circuit = one_amplifier(opamp);
  const double alone = poles(state_space(circuit)).front().real();
  circuit.capacitors = {{"C0", circuit.outputs[0], 0, 1e-9}};
  REQUIRE(state_space(circuit).states() == 1);
  CHECK(poles(state_space(circuit)).front().real() == alone);
  // R C p^2 + p + W = 0
  opamp.output_resistance = 100.0;
  circuit.amplifiers[0].opamp = opamp;
  check_pair(circuit, -1.0 / (100.0 * 1e-9), angular_bandwidth / (100.0 * 1e-9));
}

TEST_CASE("a capacitor between opposite outputs counts four times", "[nodal]") {
  // Each of two outputs, twice a voltage apart: R C p^2 of one with four times that, shared by two.
  const OpAmp opamp{.gain = 1e12, .bandwidth = bandwidth, .output_resistance = 100.0};
  Circuit circuit = one_amplifier(opamp, Outputs::complementary);
  const Node out = circuit.outputs[0];
  const Node inverse = circuit.instances[0].pins[3];
  circuit.capacitors = {{"C0", out, inverse, 1e-9}};
  const double time = 100.0 * 0.5 * 4.0 * 1e-9;
  check_pair(circuit, -1.0 / time, angular_bandwidth / time);
}

TEST_CASE("at either of two opposite outputs a capacitor does the same, or the opposite",
          "[nodal]") {
  const OpAmp opamp{.gain = 1e12, .bandwidth = bandwidth, .output_resistance = 100.0};
  Circuit circuit = one_amplifier(opamp, Outputs::complementary);
  const Node out = circuit.outputs[0];
  const Node inverse = circuit.instances[0].pins[3];
  const Node a = add_node(circuit, "a");
  circuit.resistors.push_back({"R1", a, 0, 1e-4});
  const auto poles_of = [&](std::vector<Capacitor> capacitors) {
    circuit.capacitors = std::move(capacitors);
    return poles(state_space(circuit));
  };
  circuit.sources = {{"I1", a, 1e-3}};
  const auto at_out = poles_of({{"C0", out, a, 1e-9}});
  const double at_once = state_space(circuit).direct[0];
  const auto at_inverse = poles_of({{"C0", inverse, a, 1e-9}});
  CHECK(at_once > 0.0);
  CHECK_THAT(state_space(circuit).direct[0], WithinRel(-at_once, 1e-12));
  REQUIRE(at_out.size() == 2);
  REQUIRE(at_inverse.size() == 2);
  for (std::size_t k = 0; k < 2; ++k)
    CHECK(std::abs(at_out[k] - at_inverse[k]) < 1e-9 * std::abs(at_out[k]));
  // At both the node between stays at 0: a pole of its own, and R C p^2 + p + W.
  const auto at_both = poles_of({{"C0", out, a, 1e-9}, {"C1", inverse, a, 1e-9}});
  REQUIRE(at_both.size() == 3);
  std::complex<double> sum = 0.0, product = 1.0;
  for (const std::complex<double>& one : at_both) {
    sum += one;
    product *= one;
  }
  const double own = -1e-4 / 2e-9;
  CHECK_THAT(sum.real(), WithinRel(own - 1.0 / (100.0 * 1e-9), 1e-6));
  CHECK_THAT(product.real(), WithinRel(own * angular_bandwidth / (100.0 * 1e-9), 1e-6));
}

TEST_CASE("a network that nothing ties to ground has no operating point", "[nodal]") {
  Circuit circuit;
  const Node a = add_node(circuit, "a");
  const Node b = add_node(circuit, "b");
  circuit.outputs = {a};
  circuit.resistors = {{"R0", a, b, 1e-3}};
  CHECK_THROWS_AS(NodalEquations(circuit).voltages(), std::domain_error);
  CHECK_THROWS_AS(state_space(circuit), std::domain_error);
  circuit.resistors.push_back({"R1", a, b, 0.3e-3});
  circuit.resistors.push_back({"R2", b, a, 0.7e-3});
  CHECK_THROWS_AS(state_space(circuit), std::domain_error);
}

#include "tactile_net/network/state_space.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include "tactile_net/network/certificate.hpp"
#include "tests/catch.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

double slowest(const Circuit& circuit) { return poles(state_space(circuit)).front().real(); }

}  // namespace

TEST_CASE("a resistor and a capacitor settle as exp(-t/RC)", "[state_space]") {
  const Circuit circuit = resistor_and_capacitor();
  const StateSpace system = state_space(circuit);
  CHECK_THAT(slowest(circuit), WithinRel(-1e6, 1e-12));
  CHECK_THAT(steady_state(system)[0], WithinRel(2.0, 1e-12));
  CHECK_THAT(settling_time(system, 1e-3, -1e6).value(), WithinRel(std::log(1e3) * 1e-6, 1e-3));
}

TEST_CASE("the error after a step falls as the exponential it is", "[state_space]") {
  Circuit circuit = resistor_and_capacitor();
  const std::vector<double> errors = step_errors(state_space(circuit), 0.5e-6, 20);
  REQUIRE(errors.size() == 21);
  for (std::size_t k = 0; k < errors.size(); ++k)
    CHECK_THAT(errors[k], WithinRel(std::exp(-0.5 * static_cast<double>(k)), 1e-12));
  CHECK_THROWS_AS(step_errors(state_space(circuit), 0.0, 1), std::invalid_argument);

  circuit.resistors[0].siemens = -1e-3;  // it leaves its rest as exp(t/RC)
  const std::vector<double> grows = step_errors(state_space(circuit), 0.5e-6, 4);
  for (std::size_t k = 0; k < grows.size(); ++k)
    CHECK_THAT(grows[k], WithinRel(std::exp(0.5 * static_cast<double>(k)), 1e-12));

  circuit.sources.clear();
  CHECK_THROWS_AS(step_errors(state_space(circuit), 1e-6, 1), std::domain_error);
}

TEST_CASE("settling is where the error after a step passes its accuracy", "[state_space]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::nic, Realization::least_squares}) {
    const StateSpace system =
        state_space(realize(one, network.problem, {.opamp = one_pole, .node_capacitance = 1e-12}));
    const double settled = settling_time(system, 1e-3, poles(system).front().real()).value();
    const std::vector<double> errors = step_errors(system, settled / 500.0, 1000);
    CAPTURE(name(one));
    CHECK_THAT(errors.front(), WithinRel(1.0, 1e-9));
    CHECK_THAT(errors[500], WithinRel(1e-3, 0.02));
    for (std::size_t k = 505; k < errors.size(); ++k) CHECK(errors[k] < 1e-3);
  }
}

TEST_CASE("an inverter's pole is at half its op-amp's bandwidth", "[state_space]") {
  Circuit circuit;
  circuit.amplifiers = {{"opamp", one_pole, Outputs::single}};
  const Node in = add_node(circuit, "in");
  const Node out = add_node(circuit, "out");
  circuit.outputs = {out};
  circuit.instances = {{"X0", {in, out}, "inverter"}};
  circuit.resistors = {{"R0", in, 0, 1.0}};
  circuit.sources = {{"I0", in, 1.0}};
  CHECK_THAT(slowest(circuit), WithinRel(-0.5 * angular_bandwidth, 1e-3));
  CHECK_THAT(steady_state(state_space(circuit))[0], WithinRel(-1.0, 1e-3));
}

TEST_CASE("a ringing pair settles as its envelope", "[state_space]") {
  // Two integrators in a ring: an amplifier with capacitance at its summing node.
  Circuit circuit;
  circuit.amplifiers = {
      {"amplifier", {.gain = 1e9, .bandwidth = bandwidth}, Outputs::complementary}};
  const Node s = add_node(circuit, "s0");
  const Node n = add_node(circuit, "n0");
  const Node r = add_node(circuit, "r0");
  circuit.outputs = {n};
  circuit.instances = {{"X0", {0, s, n, r}, "amplifier"}};
  circuit.resistors = {{"R0", n, s, 1e-3}};
  circuit.capacitors = {{"C0", s, 0, 1e-9}};
  circuit.sources = {{"I0", s, -1e-3}};
  // (C/W) v'' + (1/(R W)) v' + v/R = i
  const double damping = 0.5 * 1e6;
  CHECK_THAT(slowest(circuit), WithinRel(-damping, 1e-6));
  const double settled = settling_time(state_space(circuit), 1e-3, -damping).value();
  CHECK_THAT(settled, WithinRel(std::log(1e3) / damping, 0.05));
}

TEST_CASE("the state space comes to rest where the equations say", "[state_space]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const std::vector<double> v = steady_state(
        state_space(realize(one, network.problem, {.opamp = {.gain = 1e9, .bandwidth = 1e7}})));
    for (std::size_t i = 0; i < v.size(); ++i) CHECK_THAT(v[i], WithinAbs(network.direct[i], 1e-6));
  }
}

TEST_CASE("P definite or not decides, for converters, rails and crossbars of any bandwidths",
          "[state_space][property]") {
  std::mt19937 generator(5);
  const auto uniform = [&] { return static_cast<double>(generator()) / 4294967295.0; };
  for (unsigned trial = 0; trial < 40; ++trial) {
    const bool definite = trial % 2 == 0;
    const std::size_t n = 3 + trial % 5;
    Matrix p = random_definite(n, trial + 1, 0.01);
    if (!definite) {
      const double shift = smallest_eigenvalue(p) + 0.003;
      for (std::size_t i = 0; i < n; ++i) p(i, i) -= shift;
    }
    NetworkProblem problem{.matrix = p, .right_side = std::vector<double>(n, 1.0)};
    RealizationOptions options{.opamp = one_pole, .node_capacitance = 1e-12};
    for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar}) {
      Circuit circuit = realize(one, problem, options);
      // T1 and T5 hold for any bandwidths, T2 for equal ones.
      if (one != Realization::rail) {
        circuit = FlatCircuit(circuit).circuit();
        const AmplifierModel kind = circuit.amplifiers.front();
        circuit.amplifiers.clear();
        for (Instance& x : circuit.instances) {
          AmplifierModel own = kind;
          own.name = "own" + x.name;
          own.opamp.bandwidth = bandwidth * std::pow(10.0, 2.0 * uniform() - 1.0);
          x.subcircuit = own.name;
          circuit.amplifiers.push_back(own);
        }
      }
      CAPTURE(trial, name(one), definite);
      CHECK((slowest(circuit) < 0.0) == definite);
    }
  }
}

TEST_CASE("converters with swapped inputs are caught", "[state_space]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const RealizationOptions options{.opamp = one_pole};
  const Circuit circuit = realize(Realization::nic, network.problem, options);
  CHECK(slowest(circuit) < 0.0);
  // design: 20 unstable modes of 25, growing at W
  CHECK_THAT(slowest(swapped(circuit)), WithinRel(angular_bandwidth, 0.01));
}

TEST_CASE("least squares with complementary outputs is stable at every gain and bandwidth",
          "[state_space][property]") {
  std::mt19937 generator(9);
  for (const double alpha : {1e-3, 1e-6})
    for (const double rho : {1.0, 10.0, 100.0})
      for (const double ratio : {0.01, 1.0, 100.0})
        for (const bool spread : {false, true}) {
          const ArrayNetwork network = array_network(21, alpha);
          Circuit circuit =
              realize(Realization::least_squares, network.problem,
                      {.opamp = one_pole, .residual_gain = rho, .bandwidth_ratio = ratio});
          if (spread)
            for (Instance& x : circuit.instances) {
              AmplifierModel own = *amplifier(circuit, x.subcircuit);
              own.name = "own" + x.name;
              own.opamp.bandwidth =
                  *own.opamp.bandwidth *
                  std::pow(10.0, 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0);
              x.subcircuit = own.name;
              circuit.amplifiers.push_back(own);
            }
          CAPTURE(alpha, rho, ratio, spread);
          CHECK(slowest(circuit) < 0.0);
        }
  // With inverters and equal bandwidths it is not.
  const ArrayNetwork network = array_network(21, 1e-3);
  CHECK(slowest(realize(Realization::least_squares, network.problem,
                        {.opamp = one_pole, .inverters = true, .bandwidth_ratio = 1.0})) > 0.0);
}

TEST_CASE("capacitance at inverting inputs unsettles converters beyond its rule", "[state_space]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  RealizationOptions options{.opamp = {.gain = 1e6, .bandwidth = 1e7, .input_capacitance = 1e-11},
                             .node_capacitance = 1e-11};
  CHECK(slowest(realize(Realization::nic, network.problem, options)) > 0.0);
  options.divider = 1.0 / (2.0 * angular_bandwidth * 1e-11);
  CHECK(slowest(realize(Realization::nic, network.problem, options)) < 0.0);
}

TEST_CASE("what has no place in a state space is refused", "[state_space]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  CHECK_THROWS_WITH(state_space(realize(Realization::nic, network.problem)),
                    ContainsSubstring("without bandwidth"));
  CHECK_THROWS_WITH(state_space(realize(Realization::lc, network.problem)),
                    ContainsSubstring("inductor"));
}

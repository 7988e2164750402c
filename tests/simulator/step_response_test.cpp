// ngspice over time: what settles, what grows, and what would deceive.
#include "tactile_net/simulator/step_response.hpp"

#include <cmath>
#include <optional>
#include <sstream>

#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

namespace {

/// A certificate's dynamics, for circuits that no realisation makes.
Certificate certified(const Circuit& circuit) {
  const StateSpace system = state_space(circuit);
  Certificate certificate;
  certificate.dynamics = Dynamics{.states = system.states(), .slowest = poles(system)[0].real()};
  certificate.dynamics->settling_seconds =
      settling_time(system, certificate.accuracy, certificate.dynamics->slowest);
  if (certificate.dynamics->slowest > 0.0) certificate.dynamics->mode = slowest_mode(system);
  return certificate;
}

double overlap(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return std::abs(sum);
}

}  // namespace

TEST_CASE("a capacitor charges as the exponential does", "[spice][step_response]") {
  const Circuit circuit = resistor_and_capacitor();
  Ngspice ngspice;
  const Waveforms waveforms = step_response(ngspice, circuit, {.step = 1e-8, .stop = 1e-5});
  for (std::size_t k = 0; k < waveforms.time.size(); k += 50)
    CHECK_THAT(waveforms.voltages[0][k],
               WithinAbs(2.0 * (1.0 - std::exp(-waveforms.time[k] / 1e-6)), 1e-4));
  CHECK_THAT(settling_time(waveforms, std::vector{2.0}, 1e-3).value(),
             WithinRel(std::log(1e3) * 1e-6, 1e-2));
  CHECK_FALSE(settling_time(waveforms, std::vector{3.0}, 1e-3));
}

TEST_CASE("ngspice settles in the certificate's time", "[spice][step_response][long]") {
  for (const double alpha : {1e-3, 1e-5}) {
    const ArrayNetwork network = array_network(21, alpha);
    for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                  Realization::least_squares, Realization::lattice}) {
      const RealizationOptions options{.opamp = one_pole, .node_capacitance = 1e-11};
      const Certificate certificate = certify(one, network.problem, options);
      const Circuit circuit = realize(one, network.problem, options);
      Ngspice ngspice;
      const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
      CAPTURE(alpha, name(one));
      REQUIRE(seen.end == TransientEnd::settles);
      CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.02));
      CHECK(seen.end_error < 1e-3);
    }
  }
}

TEST_CASE("converters with second poles and slew settle in ngspice in the certificate's time",
          "[spice][step_response]") {
  const ArrayNetwork network = array_network(9, 1e-2);
  for (const Realization one : {Realization::nic, Realization::rail}) {
    double linear = 0.0;
    for (const std::optional<double> slew : {std::optional<double>{}, std::optional{2e6}}) {
      RealizationOptions options{.opamp = {.bandwidth = 1e7, .second_pole = 4e7, .slew = slew}};
      const Certificate certificate = certify(one, network.problem, options);
      const Circuit circuit = realize(one, network.problem, options);
      CAPTURE(name(one), slew.value_or(0.0));
      REQUIRE(certificate.stability == Stability::stable);
      const double settling = *certificate.dynamics->settling_seconds;
      Ngspice ngspice;
      const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
      REQUIRE(seen.end == TransientEnd::settles);
      CHECK_THAT(*seen.settling_seconds, WithinRel(settling, slew ? 0.05 : 0.02));
      if (slew) CHECK(settling > 1.2 * linear);  // it is what the slew makes of it
      linear = settling;
    }
  }
}

TEST_CASE("a lattice with its board's capacitances, each node's own, settles as certified",
          "[spice][step_response]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(5, 1e-3).problem);
  const RealizationOptions options{
      .scale = {.siemens = 20e-3},
      .opamp = {.gain = 1e6, .bandwidth = 10e6, .second_pole = 25e6, .input_capacitance = 4e-12}};
  const auto with = [&](double share) {
    std::vector<NodeCapacitance> each;
    const Circuit plain = realize(Realization::lattice, *problem, options);
    for (Node node = 1; node < plain.nodes.size(); ++node)
      each.push_back({plain.nodes[node], share * (4e-12 + 0.4e-12 * static_cast<double>(node))});
    return NetworkCircuit(Realization::lattice, problem, options, each);
  };
  Ngspice ngspice;
  const NetworkCircuit calm = with(1.0);
  const Certificate certificate = certify(calm);
  REQUIRE(certificate.stability == Stability::stable);
  const Transient seen = settle(ngspice, calm.circuit(), certificate, at_rest(calm.circuit()));
  REQUIRE(seen.end == TransientEnd::settles);
  CHECK_THAT(*seen.settling_seconds, WithinRel(*certificate.dynamics->settling_seconds, 0.02));
  // A planted oscillation grows as the certificate says.
  const NetworkCircuit wild = with(40.0);
  const Certificate growing = certify(wild);
  REQUIRE(growing.stability == Stability::unstable);
  const Transient grown = settle(ngspice, wild.circuit(), growing, at_rest(wild.circuit()));
  CHECK(grown.end == TransientEnd::grows);
  CHECK_THAT(grown.growth, WithinRel(growing.dynamics->slowest, 0.05));
}

TEST_CASE("a lattice settles in ngspice in the time that it was designed to",
          "[spice][step_response]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const RealizationOptions options{.opamp = one_pole};
  const Circuit circuit = realize(Realization::lattice, network.problem, options);
  Ngspice ngspice;
  const Transient seen = settle(
      ngspice, circuit, certify(Realization::lattice, network.problem, options), at_rest(circuit));
  REQUIRE(seen.end == TransientEnd::settles);
  CHECK_THAT(*seen.settling_seconds, WithinRel(1.38e-6, 0.02));
}

TEST_CASE("converters with swapped inputs agree at rest, and grow", "[spice][step_response]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const RealizationOptions options{.opamp = one_pole};
  for (const Realization one : {Realization::nic, Realization::rail}) {
    CAPTURE(name(one));
    const Circuit wrong = swapped(realize(one, network.problem, options));
    const std::vector<double> v = at_rest(wrong);
    CHECK(relative_l2_error(v, network.direct) < 2e-5);  // .op is blind
    const Certificate certificate = certified(wrong);
    CHECK(certificate.dynamics->slowest > 0.0);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, wrong, certificate, v);
    CHECK(seen.end == TransientEnd::grows);
    // The fastest modes are inside the converters; the outputs grow with slower ones.
    CHECK(seen.growth <= 1.05 * certificate.dynamics->slowest);
    CHECK(seen.growth >= 0.5 * certificate.dynamics->slowest);
  }
}

TEST_CASE("an indefinite P grows in its own mode", "[spice][step_response]") {
  Matrix p = random_definite(6, 3);
  const double shift = smallest_eigenvalue(p) + 0.05;
  for (std::size_t i = 0; i < 6; ++i) p(i, i) -= shift;
  const NetworkProblem problem{.matrix = p, .right_side = std::vector<double>(6, 1.0)};
  for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar}) {
    const RealizationOptions options{.opamp = one_pole, .node_capacitance = 1e-12};
    const Certificate certificate = certify(one, problem, options);
    const Circuit circuit = realize(one, problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    CAPTURE(name(one));
    REQUIRE(seen.end == TransientEnd::grows);
    CHECK_THAT(seen.growth, WithinRel(certificate.dynamics->slowest, 0.05));
    CHECK(overlap(seen.mode, certificate.dynamics->mode) > 0.99);
  }
}

TEST_CASE("what deceives: the DC solution as a start, and a method that damps",
          "[spice][step_response]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const Circuit wrong = swapped(realize(Realization::nic, network.problem, {.opamp = one_pole}));
  std::ostringstream deck;
  write_deck(deck, wrong, {.title = "test"}, Answer::raw_file,
             StepResponse{.step = 1e-9, .stop = 2e-7});
  const std::string step = deck.str();
  Ngspice ngspice;
  const auto last = [&](const std::string& text) {
    const Simulation simulation = ngspice.run(text);
    std::vector<double> v;
    for (const Node node : wrong.outputs)
      v.push_back(simulation.plot.vector("v(" + wrong.nodes[node] + ")").back());
    return relative_l2_error(v, network.direct);
  };
  CHECK(last(step) > 100.0);  // it grows by exp(12)

  // Sources that are on from the beginning: it stays on the unstable solution.
  std::string on = step;
  for (std::size_t at = on.find("PWL("); at != std::string::npos; at = on.find("PWL(")) {
    const std::size_t end = on.find(')', at);
    const std::size_t value = on.rfind(' ', end);
    on.replace(at, end + 1 - at, "DC" + on.substr(value, end - value));
  }
  CHECK(last(on) < 1e-3);

  // Gear with long steps: after sixty thousand times the growth's time still the wrong answer.
  const std::size_t options = on.find(".options ");
  on.replace(options, on.find('\n', options) - options, ".options method=gear");
  const std::size_t tran = on.find(".tran ");
  on.replace(tran, on.find('\n', tran) - tran, ".tran 1e-5 1e-3 0 1e-5");
  CHECK(last(on) < 1e-3);
}

TEST_CASE("overdriven amplifiers at their rails come back", "[spice][step_response]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  OpAmp clamped = one_pole;
  clamped.rail = 12.0;
  for (const Realization one :
       {Realization::nic, Realization::rail, Realization::crossbar, Realization::least_squares}) {
    const Circuit circuit =
        realize(one, network.problem,
                {.scale = {.volts = 10.0}, .opamp = clamped, .node_capacitance = 1e-11});
    const std::vector<double> end = at_rest(circuit);
    Ngspice ngspice;
    const Waveforms waveforms = step_response(
        ngspice, circuit, {.step = 2e-8, .stop = 8e-5, .overdrive = 50.0, .overdrive_until = 2e-5});
    CAPTURE(name(one));
    double highest = 0.0;
    for (const double v : waveforms.voltages[2]) highest = std::max(highest, std::abs(v));
    CHECK(highest > 1.5 * std::abs(end[2]));
    const auto settled = settling_time(waveforms, end, 1e-2);
    REQUIRE(settled);
    CHECK(*settled > 2e-5);
  }
}

TEST_CASE("a node's capacitance and no amplifier settle as the ideal network does",
          "[spice][step_response]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const RealizationOptions options{.node_capacitance = 1e-10};
  for (const Realization one : {Realization::ideal, Realization::ndr}) {
    const Certificate certificate = certify(one, network.problem, options);
    const Circuit circuit = realize(one, network.problem, options);
    Ngspice ngspice;
    const Transient seen = settle(ngspice, circuit, certificate, at_rest(circuit));
    CAPTURE(name(one));
    CHECK(seen.end == TransientEnd::settles);
    // design: 2.995e-5 s, N-shaped devices behave as their slope
    CHECK_THAT(seen.settling_seconds.value(), WithinRel(2.98e-5, 0.02));
  }
}

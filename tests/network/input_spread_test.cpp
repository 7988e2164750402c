// How offsets and bias currents are spread over builds, and what is left of them when the answer at
// rest is subtracted.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "network/opamp_draws.hpp"
#include "tactile_net/network/drawn_circuit.hpp"
#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/network/static_errors.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

/// Standard deviation of a normal error of deviation `typical` that is cut off at `limit`, by
/// Simpson's rule.
double cut_off(double typical, double limit) {
  constexpr int panels = 2000;
  double mass = 0.0;
  double square = 0.0;
  for (int k = 0; k <= panels; ++k) {
    const double x = limit * k / panels;
    const double weight = (k == 0 || k == panels ? 1.0
                           : k % 2 == 1          ? 4.0
                                                 : 2.0) *
                          std::exp(-0.5 * std::pow(x / typical, 2));
    mass += weight;
    square += weight * x * x;
  }
  return std::sqrt(square / mass);
}

/// The sources of a circuit, all of nothing.
Circuit unloaded(Circuit circuit) {
  for (CurrentSource& one : circuit.sources) {
    if (one.name.starts_with("Ib")) continue;  // what inputs take is no reading
    one.ampere = 0.0;
  }
  return circuit;
}

}  // namespace

TEST_CASE("a typical value is a standard deviation, a limit where it ends, a limit alone all alike",
          "[opamp_errors][property]") {
  CHECK(input_spread(-2e-6, {}).deviation == 2e-6);
  CHECK_THAT(input_spread(3e-4, 3e-4).deviation, WithinRel(3e-4 / std::sqrt(3.0), 1e-12));
  CHECK_THAT(input_spread(1e-6, 1.0).deviation, WithinRel(1e-6, 1e-12));
  for (const double limit : {1.01, 1.5, 2.0, 4.0, 8.0})
    CHECK_THAT(input_spread(5e-5, limit * 5e-5).deviation,
               WithinRel(cut_off(5e-5, limit * 5e-5), 1e-9));

  // As many draws as tell the deviation within 2 %, five times over.
  constexpr std::size_t count = 40'000;
  for (const double limit : {1.0, 1.5, 3.0, std::numeric_limits<double>::infinity()}) {
    CAPTURE(limit);
    const InputSpread spread = input_spread(1.0, limit);
    double sum = 0.0;
    double square = 0.0;
    double most = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const double drawn = spread.deviation * input_error(spread, 3, k % 7, k);
      sum += drawn;
      square += drawn * drawn;
      most = std::max(most, std::abs(drawn));
    }
    CHECK(most <= limit);
    if (limit < 2.0) CHECK(most > 0.99 * limit);
    CHECK_THAT(std::sqrt(square / count), WithinRel(spread.deviation, 0.02));
    CHECK_THAT(sum / count, WithinAbs(0.0, 0.03 * spread.deviation));
  }
}

TEST_CASE("builds have offsets and bias currents within their limits, each with its own",
          "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  const OpAmp opamp{.gain = 1e6,
                    .bandwidth = 1e7,
                    .offset = 2e-4,
                    .offset_limit = 2e-4,
                    .bias_current = 1e-9,
                    .bias_limit = 2e-9};
  const FlatCircuit circuit(
      realize(Realization::lattice, network.problem, {.scale = {1e-2, 2.0}, .opamp = opamp}));
  const auto resistors = circuit.circuit().resistors;
  std::vector<double> printed;
  for (const Resistor& one : resistors) printed.push_back(one.siemens);
  const ResistorErrors exact(std::vector<double>(printed.size(), 0.0));
  double square = 0.0;
  std::size_t count = 0;
  for (std::size_t build = 0; build < 2000; ++build)
    for (const AmplifierModel& model :
         drawn_circuit(circuit, {printed, exact}, 11, build).amplifiers) {
      CHECK(std::abs(*model.opamp.offset) <= 2e-4);
      CHECK(std::abs(*model.opamp.bias_current) <= 2e-9);
      square += std::pow(*model.opamp.offset, 2);
      ++count;
    }
  CHECK_THAT(std::sqrt(square / static_cast<double>(count)),
             WithinRel(2e-4 / std::sqrt(3.0), 0.015));
}

TEST_CASE("of exact resistors and op-amps that have offsets alone nothing is left after a tare",
          "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const auto circuit = [&](const OpAmp& opamp) {
      return realize(one, network.problem, {.scale = {1e-2, 1.0}, .opamp = opamp});
    };
    // Of a gain that errs by less than all that is seen here.
    const FlatCircuit flat(
        circuit({.gain = 1e13, .offset = 2e-4, .offset_limit = 2e-4, .bias_current = 1e-8}));
    const Reduction reduction(flat);
    const std::vector<Load> loads = {flat.circuit().sources};
    const OpAmpErrors errors = opamp_errors(flat, loads);
    const LoadedNetwork ordered(reduction, loads, {.errors = errors});
    const LoadedNetwork tared(reduction, loads, {.errors = errors, .tare = true});
    const ResistorErrors exact(std::vector<double>(reduction.resistors().size(), 0.0));
    CHECK(ordered.builds(reduction.siemens(), exact, 20, 5).front() > 1e-5);
    CHECK(tared.builds(reduction.siemens(), exact, 20, 5).back() < 1e-9);
    CHECK(tared.opamp_shares().offset == 0.0);
    CHECK(tared.opamp_shares().bias_current == 0.0);
    // What is subtracted is told as it is.
    CHECK(tared.offsets(exact, 20, 5) == ordered.offsets(exact, 20, 5));

    // Resistors that are off err as they do with op-amps that have no offset.
    const FlatCircuit without(circuit({.gain = 1e13}));
    const LoadedNetwork none(reduction, loads, {.errors = opamp_errors(without, loads)});
    const ResistorErrors off(std::vector<double>(reduction.resistors().size(), 0.01));
    const std::vector<double> seen = tared.builds(reduction.siemens(), off, 20, 5);
    const std::vector<double> expected = none.builds(reduction.siemens(), off, 20, 5);
    for (std::size_t k = 0; k < seen.size(); ++k) CHECK_THAT(seen[k], WithinRel(expected[k], 1e-9));

    // And so says the circuit of each build, with its answer at rest subtracted.
    std::vector<double> printed(reduction.siemens().begin(), reduction.siemens().end());
    const std::vector<double> answer = operating_voltages(FlatCircuit(circuit({.gain = 1e13})));
    std::vector<double> built;
    for (std::size_t build = 0; build < 20; ++build) {
      const Circuit one_build = drawn_circuit(flat, {printed, off}, 5, build);
      std::vector<double> read = operating_voltages(FlatCircuit(one_build));
      const std::vector<double> rest = operating_voltages(FlatCircuit(unloaded(one_build)));
      for (std::size_t i = 0; i < read.size(); ++i) read[i] -= rest[i];
      built.push_back(relative_l2_error(read, answer));
    }
    std::sort(built.begin(), built.end());
    for (std::size_t k = 0; k < built.size(); ++k) CHECK_THAT(built[k], WithinRel(seen[k], 1e-5));
  }
}

TEST_CASE("after a tare offsets are off by their drift times the temperature",
          "[opamp_errors][property]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  const OpAmp opamp{.gain = 1e12, .offset = 1e-4, .offset_drift = 2e-6};
  const FlatCircuit flat(
      realize(Realization::lattice, network.problem, {.scale = {1e-2, 1.0}, .opamp = opamp}));
  const Reduction reduction(flat);
  const std::vector<Load> loads = {flat.circuit().sources};
  const std::size_t resistors = reduction.resistors().size();
  const auto rms = [&](double kelvin, bool tare) {
    const LoadedNetwork loaded(reduction, loads,
                               {.errors = opamp_errors(flat, loads), .tare = tare});
    CommonErrors common;
    if (kelvin > 0.0) common.temperature = Temperature{.kelvin = kelvin};
    const ResistorErrors exact(
        std::vector<ResistorError>(resistors, {.kind = ResistorError::Kind::none}), common);
    double square = 0.0;
    const std::vector<double> errors = loaded.builds(reduction.siemens(), exact, 2000, 1);
    for (const double one : errors) square += one * one;
    return std::sqrt(square / static_cast<double>(errors.size()));
  };
  const double offset = rms(0.0, false);
  CHECK(rms(0.0, true) < 1e-8);
  // Uniform in a temperature that is uniform: a third of their product, where an offset is normal.
  CHECK_THAT(rms(30.0, true), WithinRel(offset * 30.0 * 2e-6 / 3.0 / 1e-4, 0.05));
  CHECK_THAT(rms(30.0, false), WithinRel(std::hypot(offset, rms(30.0, true)), 0.03));

  // The circuit of a build has the same.
  const ResistorErrors warm(
      std::vector<ResistorError>(resistors, {.kind = ResistorError::Kind::none}),
      {.temperature = Temperature{.kelvin = 30.0}});
  std::vector<double> printed(reduction.siemens().begin(), reduction.siemens().end());
  const std::vector<double> exact = operating_voltages(
      FlatCircuit(realize(Realization::lattice, network.problem, {.scale = {1e-2, 1.0}})));
  const double built = relative_l2_error(
      operating_voltages(FlatCircuit(drawn_circuit(flat, {printed, warm}, 9, 0))), exact);
  const LoadedNetwork loaded(reduction, loads, {.errors = opamp_errors(flat, loads)});
  CHECK_THAT(built, WithinRel(loaded.builds(printed, warm, 1, 9).front(), 1e-6));
}

TEST_CASE("a yield after a tare has no offsets", "[opamp_errors][tolerance]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  const auto p95 = [&](const OpAmp& opamp, bool tare) {
    const NetworkCircuit circuit(Realization::lattice,
                                 std::make_shared<const NetworkProblem>(network.problem),
                                 {.scale = {1e-2, 1.0}, .opamp = opamp});
    return tolerate(circuit, {.relative = 1e-3, .tare = tare, .trials = 100}).p95;
  };
  const OpAmp off{.gain = 1e6, .offset = 1e-3, .bias_current = 1e-7};
  CHECK(p95(off, false) > 2.0 * p95(off, true));
  CHECK_THAT(p95(off, true), WithinRel(p95({.gain = 1e6}, false), 1e-9));
}

TEST_CASE("a typical value above its limit is refused", "[opamp_errors]") {
  CHECK_THROWS_AS(check(OpAmp{.gain = 1e6, .offset = -2e-4, .offset_limit = 1e-4}),
                  std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.gain = 1e6, .bias_current = 2e-9, .bias_limit = 1e-9}),
                  std::invalid_argument);
  CHECK_THROWS_AS(check(OpAmp{.gain = 1e6, .offset_drift = 0.0}), std::invalid_argument);
  CHECK_NOTHROW(check(OpAmp{.gain = 1e6, .offset = -1e-4, .offset_limit = 1e-4}));
}

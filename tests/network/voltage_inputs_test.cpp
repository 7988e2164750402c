// Readings that come as voltages through resistors of the circuit.
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/motion.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

struct InputForm {
  Realization realization;
  bool ladder = false;
};
constexpr std::array input_forms = {
    InputForm{Realization::crossbar}, InputForm{Realization::least_squares},
    InputForm{Realization::least_squares, true}, InputForm{Realization::lattice}};

RealizationOptions options_of(const InputForm& form, Inputs inputs, const OpAmp& opamp = {}) {
  RealizationOptions options{.opamp = opamp, .inputs = inputs};
  options.ladder = form.ladder;
  return options;
}

Circuit built(const InputForm& form, const NetworkProblem& problem, Inputs inputs,
              const OpAmp& opamp = {}) {
  return realize(form.realization, problem, options_of(form, inputs, opamp));
}

/// Every resistor that much larger.
Circuit with_larger(Circuit circuit, double by) {
  for (Resistor& one : circuit.resistors) one.siemens /= by;
  return circuit;
}

/// A source of voltage as anyone may have it: a current into a conductance that nothing else of the
/// circuit comes near, at a node as all others are.
Circuit with_stiff_sources(Circuit circuit, double siemens) {
  for (CurrentSource& one : circuit.sources) {
    if (!one.volts) continue;
    circuit.resistors.push_back({"Rstiff" + one.name, one.into, 0, siemens});
    one = {"I" + one.name, one.into, siemens * *one.volts};
  }
  return circuit;
}

double total(const OutputNoise& noise) {
  double sum = 0.0;
  for (std::size_t i = 0; i < noise.thermal.rows; ++i) sum += noise.thermal(i, i);
  return sum;
}

}  // namespace

TEST_CASE("voltages through resistors have the answer that currents have", "[voltage_inputs]") {
  const double alpha = GENERATE(1e-3, 1e-5);
  const ArrayNetwork network = array_network(11, alpha);
  for (const InputForm& form : input_forms)
    for (const bool inverters : {false, true}) {
      if (form.ladder && inverters) continue;
      CAPTURE(alpha, name(form.realization), form.ladder, inverters);
      RealizationOptions options = options_of(form, Inputs::voltage);
      options.inverters = inverters;
      options.scale.volts = 3.0;
      const Circuit circuit = realize(form.realization, network.problem, options);
      std::vector<double> rest = operating_voltages(FlatCircuit(circuit));
      for (double& one : rest) one /= 3.0;
      CHECK(relative_l2_error(rest, network.direct) < 1e-9);
      CHECK(try_out(Reduction(circuit), Reduction(circuit).siemens()).stable);
      const std::size_t pairs = form.realization == Realization::lattice ? 2 : 1;
      CHECK(circuit.sources.size() == pairs * 11);
    }
}

TEST_CASE("no reading's voltage is above the largest that the answer has with it",
          "[voltage_inputs][property]") {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 20; ++trial) {
    NetworkProblem problem = array_network(11, 1e-3).problem;
    double largest = 0.0;
    std::vector<double> f;
    for (std::size_t j = 0; j < 11; ++j) {
      f.push_back(static_cast<double>(generator()) / 2147483648.0 - 1.0);
      largest = std::max(largest, std::abs(f.back()));
    }
    for (std::size_t i = 0; i < 11; ++i) {
      problem.readings[i] = problem.right_side[i] = 0.0;
      for (std::size_t j = 0; j < 11; ++j) {
        problem.readings[i] += problem.kernel(i, j) * f[j];
        problem.right_side[i] += problem.matrix(i, j) * f[j];
      }
    }
    for (const InputForm& form : input_forms)
      for (const CurrentSource& one : built(form, problem, Inputs::voltage).sources)
        CHECK(std::abs(one.volts.value()) <= largest * (1.0 + 1e-12));
  }
}

TEST_CASE("what all resistors have in common cancels: exactly, with any gain and output resistance",
          "[voltage_inputs][property]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const InputForm& form : input_forms) {
    CAPTURE(name(form.realization), form.ladder);
    const auto moved = [&](Inputs inputs, const OpAmp& opamp) {
      const Circuit circuit = built(form, network.problem, inputs, opamp);
      const Reduction reduction(circuit);
      const Circuit larger = with_larger(circuit, 1.004);
      // The nodal equations, and the reduction from conductances that are drawn.
      std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
      for (double& one : siemens) one /= 1.004;
      const double off = relative_l2_error(operating_voltages(FlatCircuit(larger)),
                                           operating_voltages(FlatCircuit(circuit)));
      if (opamp.is_nullor()) CHECK_THAT(try_out(reduction, siemens).error, WithinAbs(off, 1e-9));
      return off;
    };
    CHECK_THAT(moved(Inputs::current, {}), WithinRel(4e-3, 1e-6));
    CHECK(moved(Inputs::voltage, {}) < 1e-10);
    CHECK(moved(Inputs::voltage, {.gain = 100.0}) < 1e-10);
    // With what is no ratio of resistors it does not cancel, but counts as little as that does.
    const double behind = moved(Inputs::voltage, {.gain = 1e3, .output_resistance = 50.0});
    CHECK(behind > 0.0);
    CHECK(behind < 1e-4);
  }
}

TEST_CASE("a reel's and a temperature's common errors cancel in draws too, each part's own do not",
          "[voltage_inputs][tolerance][property]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const InputForm& form : input_forms) {
    CAPTURE(name(form.realization), form.ladder);
    const auto result = [&](Inputs inputs, const ToleranceOptions& options) {
      return tolerate(Reduction(built(form, network.problem, inputs)), options);
    };
    const auto rms = [](const ToleranceResult& one) {
      return l2_norm(one.errors) / std::sqrt(static_cast<double>(one.errors.size()));
    };
    const ToleranceOptions reel{.common = {.reel = 4e-3}, .trials = 400};
    const ToleranceResult currents = result(Inputs::current, reel);
    CHECK_THAT(currents.predicted, WithinRel(4e-3 / std::sqrt(3.0), 1e-6));
    CHECK_THAT(rms(currents), WithinRel(currents.predicted, 0.1));
    CHECK(result(Inputs::voltage, reel).errors.back() < 1e-10);
    CHECK(result(Inputs::voltage, reel).predicted < 1e-10);

    const ToleranceOptions warm{.common = {.temperature = Temperature{40.0, 50e-6, 0.0}},
                                .trials = 400};
    CHECK_THAT(result(Inputs::current, warm).predicted, WithinRel(40.0 * 50e-6 / 3.0, 1e-6));
    CHECK_THAT(rms(result(Inputs::current, warm)), WithinRel(40.0 * 50e-6 / 3.0, 0.15));
    CHECK(result(Inputs::voltage, warm).errors.back() < 1e-10);

    // Of each part's own, tolerance or tracking, first order predicts what draws find.
    for (const ToleranceOptions& own :
         {ToleranceOptions{.relative = 1e-3, .common = {.reel = 4e-3}, .trials = 400},
          ToleranceOptions{.common = {.temperature = Temperature{40.0, 50e-6, 10e-6}},
          .trials = 400}}) {
      const ToleranceResult voltages = result(Inputs::voltage, own);
      CHECK(voltages.predicted > 1e-5);
      CHECK_THAT(rms(voltages), WithinRel(voltages.predicted, 0.1));
    }
  }
}

TEST_CASE("parts are drawn with the mean and the spread of a reel that was measured",
          "[voltage_inputs][tolerance]") {
  // 20 parts of 1 kilo-ohm, half of them 0.3 % high, half 0.5 %.
  std::vector<double> ohms(20, 1003.0);
  for (std::size_t k = 0; k < 10; ++k) ohms[k] = 1005.0;
  const MeasuredReel reel = measured_reel(ohms, 1e3);
  CHECK_THAT(reel.mean, WithinRel(4e-3, 1e-9));
  CHECK_THAT(reel.spread, WithinRel(1e-3 * std::sqrt(20.0 / 19.0), 1e-9));
  CHECK_THROWS_AS(measured_reel(std::vector{1e3}, 1e3), std::invalid_argument);
  CHECK_THROWS_WITH(measured_reel(std::vector{1.0, 1.0}, 1e3),
                    ContainsSubstring("part 1 is further than 10 %"));

  const NetworkProblem problem = array_network(11, 1e-3).problem;
  const ToleranceOptions options{.common = {.measured = reel}, .trials = 300};
  const Reduction currents(built(input_forms[3], problem, Inputs::current));
  double mean = 0.0;
  double square = 0.0;
  double count = 0.0;
  for (std::size_t trial = 0; trial < 20; ++trial) {
    const std::vector<double> siemens = drawn(currents, options, trial);
    for (std::size_t r = 0; r < siemens.size(); ++r, ++count) {
      const double error = currents.siemens()[r] / siemens[r] - 1.0;
      mean += error;
      square += error * error;
    }
  }
  mean /= count;
  CHECK_THAT(mean, WithinRel(4e-3, 0.05));
  CHECK_THAT(std::sqrt(square / count - mean * mean), WithinRel(reel.spread, 0.06));

  // The mean moves an answer of currents in every build, one of voltages in none.
  CHECK(tolerate(currents, options).errors.front() > 3e-3);
  const Reduction voltages(built(input_forms[3], problem, Inputs::voltage));
  const ToleranceResult own = tolerate(voltages, options);
  CHECK(own.p95 < 2e-3);
  CHECK_THAT(l2_norm(own.errors) / std::sqrt(300.0), WithinRel(own.predicted, 0.1));
  // Where a tolerance is stated beside it, it is of those parts alone that have none.
  const ToleranceOptions stabiliser{.stabiliser = 1e-6, .common = {.measured = reel}};
  const std::vector<double> siemens = drawn(voltages, stabiliser, 0);
  for (std::size_t r = 0; r < siemens.size(); ++r)
    if (voltages.resistors()[r].rfind("Rs", 0) == 0)
      CHECK(std::abs(voltages.siemens()[r] / siemens[r] - 1.0) <= 1e-6);
}

TEST_CASE("a circuit of voltages is in all its equations the one of stiff sources",
          "[voltage_inputs]") {
  const ArrayNetwork network = array_network(7, 1e-3);
  for (const InputForm& form : input_forms) {
    CAPTURE(name(form.realization), form.ladder);
    const OpAmp opamp{.gain = 1e5,
                      .bandwidth = 1e7,
                      .second_pole = 1e8,
                      .input_capacitance = 2e-13,
                      .noise_voltage = 3e-9,
                      .noise_current = 1e-12};
    RealizationOptions options = options_of(form, Inputs::voltage, opamp);
    options.residual_gain = 1.0;
    if (form.ladder) options.node_capacitance = 1e-13;
    const Circuit plain = realize(form.realization, network.problem, options);
    const Circuit stiff = with_stiff_sources(plain, 1e6);
    CHECK(relative_l2_error(operating_voltages(FlatCircuit(plain)),
                            operating_voltages(FlatCircuit(stiff))) < 1e-7);
    const StateSpace system = state_space(FlatCircuit(plain));
    const StateSpace other = state_space(FlatCircuit(stiff));
    const auto own = poles(system);
    REQUIRE(own.front().real() < 0.0);
    CHECK(system.states() == other.states());
    CHECK(std::abs(own.front() - poles(other).front()) < 1e-6 * std::abs(own.front()));
    CHECK_THAT(total(output_noise(FlatCircuit(plain))),
               WithinRel(total(output_noise(FlatCircuit(stiff))), 1e-6));

    // Through capacitance across an input's resistor a step arrives at once, and its rate while it
    // moves.
    options.resistor_capacitance = 2e-13;
    const NetworkCircuit circuit(form.realization,
                                 std::make_shared<const NetworkProblem>(network.problem), options);
    const StateSpace coupled = circuit.state_space();
    REQUIRE(coupled.jump.size() == coupled.states());
    // Not too stiff for the exponential of its equations.
    const Circuit slow = with_stiff_sources(circuit.circuit(), 1e3);
    const StateSpace stiffly = state_space(FlatCircuit(slow));
    const double step = 1e-8;
    const std::vector<double> errors = step_errors(coupled, step, 60);
    const std::vector<double> seen = step_errors(stiffly, step, 60);
    for (std::size_t k = 1; k <= 60; ++k)
      CHECK_THAT(errors[k], WithinAbs(seen[k], 1e-5 * (1.0 + seen[k])));
    CHECK(std::abs(step_errors(state_space(FlatCircuit(plain)), step, 1)[1] - errors[1]) > 1e-4);
    const MotionLag lag = motion_lag(circuit, network.problem.readings);
    // All readings rise together: after long the answer is behind by that delay of itself.
    CHECK(lag.seconds > 0.0);
    double behind = 0.0;
    const std::vector<double> tail = step_errors(coupled, 1e-8, 4000);
    for (std::size_t k = 1; k <= 4000; ++k) behind += 0.5e-8 * (tail[k - 1] + tail[k]);
    CHECK(lag.seconds <= behind * 1.01);  // the integral of a norm is not below that of its vector
  }
}

TEST_CASE("an input's resistors load residuals, and T7 holds with them", "[voltage_inputs]") {
  std::mt19937 generator(11);
  const auto uniform = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(generator()) / 4294967295.0;
  };
  for (int trial = 0; trial < 60; ++trial) {
    NetworkProblem problem = array_network(5, std::pow(10.0, uniform(-5.0, -1.0))).problem;
    for (double& one : problem.kernel.values) one *= uniform(-1.0, 1.0);
    RealizationOptions options{.opamp = {.gain = std::pow(10.0, uniform(2.0, 9.0)),
                                         .bandwidth = bandwidth,
                                         .second_pole = uniform(2.0, 8.0) * bandwidth,
                                         .input_capacitance = std::pow(10.0, uniform(-13.0, -9.0))},
                               .inputs = Inputs::voltage};
    const Certificate c = certify(Realization::lattice, problem, options);
    CHECK(c.theorem.holds());
    CHECK(c.stability == Stability::stable);
  }
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  const Circuit circuit = built(input_forms[3], problem, Inputs::voltage);
  const Reduction reduction(circuit);
  const Equations equations = reduction.equations();
  // Every residual has the same weight: b a / D, its arrays' conductances over its total.
  std::vector<double> weights;
  for (std::size_t row = 0; row < 11; ++row) {
    double sum = 0.0;
    double a = 0.0;
    double b = 0.0;
    const auto node = static_cast<Node>(
        std::find(circuit.nodes.begin(), circuit.nodes.end(), "u" + std::to_string(row)) -
        circuit.nodes.begin());
    for (const Resistor& one : circuit.resistors) {
      if (one.from != node && one.to != node) continue;
      sum += one.siemens;
      const std::string entry = std::to_string(row) + "_5";
      if (one.name.rfind("Rk" + entry, 0) == 0) a = one.siemens;
      if (one.name.rfind("Rt" + entry, 0) == 0) b = one.siemens;
    }
    weights.push_back(a * b / sum / std::pow(problem.kernel(row, 5), 2));
  }
  for (const double one : weights) CHECK_THAT(one, WithinRel(weights[0], 1e-9));
}

TEST_CASE("circuits whose nodes carry the answer take no voltages", "[voltage_inputs]") {
  const NetworkProblem problem = array_network(5, 1e-3).problem;
  for (const Realization one : realizations) {
    if (traits(one).drives_nodes) continue;
    CHECK_THROWS_WITH(realize(one, problem, {.inputs = Inputs::voltage}),
                      ContainsSubstring("would load the answer"));
  }
}

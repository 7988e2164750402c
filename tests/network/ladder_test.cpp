#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/slewing.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

const OpAmp huge_gain{.gain = 1e10, .bandwidth = 1e7};

Circuit ladder(const NetworkProblem& problem, const OpAmp& opamp = {}) {
  return realize(Realization::least_squares, problem, {.opamp = opamp, .ladder = true});
}

std::vector<double> rest(const NetworkProblem& problem) {
  return steady_state(state_space(FlatCircuit(ladder(problem, huge_gain))));
}

ToleranceResult with_parts(const NetworkProblem& problem, bool ladder, std::size_t trials) {
  const Circuit circuit = realize(Realization::least_squares, problem, {.ladder = ladder});
  return tolerate(Reduction(circuit), {.relative = 0.01, .trials = trials});
}

}  // namespace

TEST_CASE("a ladder's resistors are all positive and named after what they stand for", "[ladder]") {
  const Circuit circuit = ladder(array_network(21, 1e-3).problem);
  const ElementCounts counts = count_elements(circuit);
  CHECK(counts.opamps == 42);
  CHECK(counts.negative_resistors == 0);
  CHECK(counts.sources == 21);
  std::size_t stabiliser = 0;
  std::size_t ground = 0;
  for (const Resistor& one : circuit.resistors) {
    stabiliser += place_of(one.name).array == Array::stabiliser ? 1U : 0U;
    ground += place_of(one.name).array == Array::ground ? 1U : 0U;
  }
  CHECK(stabiliser == 2 * 21 + 2 * 20 + 21);  // feeds, segments, main amplifiers' feedback
  CHECK(ground <= 3 * 21);
  CHECK(counts.resistors == 2 * 21 * 21 + 21 + stabiliser + ground);
  CHECK(output_names(circuit)[5] == "n5");
}

TEST_CASE("a ladder rests at the direct solve, whatever the surface and the quantities",
          "[ladder][property]") {
  for (const std::size_t unknowns : {1U, 2U})
    for (const std::size_t count : {2U, 5U, 21U})
      for (const double alpha : {1e-1, 1e-3}) {
        CAPTURE(unknowns, count, alpha);
        const ArrayNetwork network = array_network(count, alpha, unknowns);
        CHECK(relative_l2_error(rest(network.problem), network.direct) < 1e-7);
      }
}

TEST_CASE("small alpha and readings a thousand times apart leave a ladder its answer",
          "[ladder][hard]") {
  ArrayNetwork network = array_network(11, 1e-8);
  // The amplifiers' gain of 1e10 is over alpha.
  CHECK(relative_l2_error(rest(network.problem), network.direct) < 1e-3);

  // Two tractions apart in the stabiliser by six decades: two ladders of their own conductances.
  const ArrayNetwork apart = array_network(7, 1e-2, 2);
  NetworkProblem problem = apart.problem;
  const std::size_t n = problem.matrix.rows;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n / 2; j < n; ++j) {
      problem.kernel(i, j) *= 1e-3;
      problem.stabiliser(i, j) *= 1e-6;
    }
  for (std::size_t i = 0; i < n; ++i) {
    problem.right_side[i] = 0.0;
    for (std::size_t k = 0; k < n; ++k)
      problem.right_side[i] += problem.kernel(k, i) * problem.readings[k];
    for (std::size_t j = 0; j < n; ++j) {
      problem.matrix(i, j) = problem.stabiliser(i, j);
      for (std::size_t k = 0; k < n; ++k)
        problem.matrix(i, j) += problem.kernel(k, i) * problem.kernel(k, j);
    }
  }
  std::vector<double> found = rest(problem);  // f of the second traction counts a thousandth
  for (std::size_t i = n / 2; i < n; ++i) found[i] *= 1e-3;
  CHECK(relative_l2_error(found, apart.direct) < 1e-3);
}

TEST_CASE("a dead taxel has no residual, and tractions that no taxel sees are fed as others are",
          "[ladder][hard]") {
  NetworkProblem problem = array_network(7, 1e-3).problem;
  for (std::size_t j = 0; j < 7; ++j) problem.kernel(3, j) = 0.0;
  const Circuit circuit = ladder(problem, huge_gain);
  CHECK(circuit.sources.size() == 6);
  CHECK(poles(state_space(FlatCircuit(circuit))).front().real() < 0.0);

  problem = array_network(2, 1e-3).problem;
  for (std::size_t i = 0; i < 2; ++i) {
    problem.kernel(i, 1) = 0.0;
    problem.stabiliser(0, 1) = problem.stabiliser(1, 0) = 0.0;
  }
  const std::vector<double> found = rest(problem);
  CHECK(found[0] > 0.1);
  CHECK_THAT(found[1], WithinAbs(0.0, 1e-12));
}

TEST_CASE("a stabiliser that resistors cannot make is refused", "[ladder]") {
  NetworkProblem problem = array_network(5, 1e-3).problem;
  NetworkProblem coupled = problem;
  coupled.stabiliser(0, 2) = coupled.stabiliser(2, 0) = 1e-6;
  CHECK_THROWS_WITH(ladder(coupled), ContainsSubstring("beside its diagonal: leave out ladder"));
  problem.stabiliser(2, 2) *= 0.5;
  CHECK_THROWS_WITH(ladder(problem), ContainsSubstring("not > 0: leave out ladder"));
  CHECK_NOTHROW(realize(Realization::least_squares, coupled));
}

TEST_CASE("a ladder settles and swings as it was designed to", "[ladder]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const Certificate c = certify(Realization::least_squares, network.problem,
                                {.opamp = {.gain = 1e6, .bandwidth = 1e7}, .ladder = true});
  CHECK(c.ladder);
  CHECK(c.theorem.name == "T6L");
  CHECK(c.theorem.holds());
  CHECK(c.stability == Stability::stable);
  CHECK_THAT(c.dynamics.value().settling_seconds.value(), WithinRel(2.985e-6, 0.02));
  CHECK_FALSE(c.tolerance_margin);  // its energy's metric is made of the parts that err
  double largest = 0.0;
  for (const double f : network.direct) largest = std::max(largest, std::abs(f));
  CHECK_THAT(c.largest_voltage / largest, WithinRel(3.1, 0.05));
  // Other realisations have no such form.
  CHECK_FALSE(certify(Realization::lattice, network.problem, {.ladder = true}).ladder);
}

TEST_CASE("a ladder of parts within 1 % keeps what differences of large currents lose",
          "[ladder][tolerance]") {
  const NetworkProblem problem = array_network(41, 1e-3).problem;
  const ToleranceResult without = with_parts(problem, false, 100);
  const ToleranceResult with = with_parts(problem, true, 200);
  CHECK_THAT(without.median, WithinRel(7.4e-3, 0.1));
  CHECK(with.stable == 200);
  CHECK_THAT(with.median, WithinRel(2.2e-3, 0.1));
  CHECK(with.p95 < 3.8e-3);
  CHECK_THAT(with.predicted, WithinRel(with.median, 0.2));
  // At small alpha K is the error, and a ladder changes nothing.
  const NetworkProblem small = array_network(21, 1e-5).problem;
  CHECK_THAT(with_parts(small, true, 100).median / with_parts(small, false, 100).median,
             WithinAbs(1.0, 0.15));
}

TEST_CASE("draws of a ladder's parts are stable where their poles are", "[ladder][property]") {
  // Half of each value: far enough for some to be unstable, which the reduced equations must see.
  const NetworkProblem problem = array_network(7, 1e-4).problem;
  const Reduction reduction(ladder(problem));
  const FlatCircuit flat(ladder(problem, huge_gain));
  std::size_t unstable = 0;
  for (std::size_t trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const std::vector<double> siemens =
        drawn(reduction, {.relative = 0.5, .trials = 60, .seed = 3}, trial);
    const Trial seen = try_out(reduction, siemens);
    const StateSpace system = state_space(FlatCircuit(perturbed(flat, siemens)));
    const double slowest = poles(system).front().real();
    CHECK(seen.stable == (slowest < 0.0));
    if (!(slowest < 0.0)) ++unstable;
    CHECK(relative_l2_error(steady_state(system), seen.voltages) < 1e-3);
  }
  CHECK(unstable > 3);
  CHECK(unstable < 57);
}

TEST_CASE("the lag of one taxel's ladder is its formula by hand", "[ladder][certificate]") {
  const NetworkProblem problem{.matrix = {1, 1, {0.69}},
                               .right_side = {0.8},
                               .kernel = {1, 1, {0.8}},
                               .stabiliser = {1, 1, {0.05}},
                               .readings = {1.0}};
  // Conductances of K and of both feedbacks; half of each half of the ladder goes to ground.
  const double k = 1e-3 * 0.8 * 0.8;
  const double feedback = k / 10.0;
  const double main = k + 10.0 * 1e-3 * 0.025;
  const double residual = k + feedback - k * k / (2.0 * k);
  const double theta2 = 0.5 * k * k / (residual * main);
  const double gamma = feedback / residual;
  const double w = 2.0 * 3.14159265358979324 * 1e7;
  const auto number = [&](const RealizationOptions& options) {
    const Certificate c = certify(Realization::least_squares, problem, options);
    return c.theorem.unmet.value().lag.number;
  };
  RealizationOptions options{
      .opamp = {.bandwidth = 1e7, .second_pole = 2e7, .input_capacitance = 2e-12}, .ladder = true};
  const double lag = 0.5 + w * 2e-12 / std::min(main, residual);
  for (const double gain : {1e6, 10.0, 1.0}) {
    options.opamp.gain = gain;
    const double left = 1.0 - 0.25 * (1.0 + 1.0 / gain) * lag;
    CHECK_THAT(number(options), WithinRel(4.0 * theta2 * lag / (gamma * left * left), 1e-9));
  }
  options.opamp.second_pole.reset();
  options.opamp.input_capacitance.reset();
  options.node_capacitance = 1e-11;
  CHECK_THAT(number(options), WithinRel(4.0 * theta2 * w * 1e-11 / (2.0 * k) / gamma, 1e-9));
}

TEST_CASE("the noise of a ladder has a size where its nodes have capacitance", "[ladder][noise]") {
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  RealizationOptions options{.opamp = {.gain = 1e6, .bandwidth = 1e6, .noise_voltage = 5e-9},
                             .ladder = true};
  const auto says = [](const Certificate& c) {
    return std::any_of(c.remarks.begin(), c.remarks.end(), [](const CircuitRemark& one) {
      return one.kind == CircuitRemark::Kind::noise_without_capacitance;
    });
  };
  const Certificate white = certify(Realization::least_squares, problem, options);
  CHECK_FALSE(white.noise);
  CHECK(says(white));
  options.node_capacitance = 1e-13;
  const Certificate held = certify(Realization::least_squares, problem, options);
  CHECK(held.noise);
  CHECK_FALSE(says(held));
}

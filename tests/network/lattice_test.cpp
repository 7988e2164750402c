#include <algorithm>
#include <cmath>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tests/catch.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

ToleranceResult with_parts(const NetworkProblem& problem, double relative) {
  return tolerate(Reduction(realize(Realization::lattice, problem)),
                  {.relative = relative, .trials = 300});
}

}  // namespace

TEST_CASE("a lattice has one amplifier a traction, and every part twice", "[lattice]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  const ElementCounts counts = count_elements(realize(Realization::lattice, network.problem));
  CHECK(counts.opamps == 21);
  CHECK(counts.resistors == 4 * 21 * 21 + 2 * (3 * 21 - 2));
  CHECK(counts.negative_resistors == 0);
  CHECK(counts.sources == 42);
}

TEST_CASE("a lattice's residuals are balanced: every one counts as much, whatever its row",
          "[lattice][property]") {
  ArrayNetwork network = array_network(11, 1e-3);
  // Rows a thousand times apart, as of two quantities in units of their noise: another problem.
  NetworkProblem problem = network.problem;
  for (std::size_t i = 0; i < problem.kernel.rows; i += 2) {
    for (std::size_t j = 0; j < problem.kernel.columns; ++j) problem.kernel(i, j) *= 1e-3;
    problem.readings[i] *= 1e-3;
  }
  for (std::size_t i = 0; i < problem.matrix.rows; ++i) {
    problem.right_side[i] = 0.0;
    for (std::size_t k = 0; k < problem.kernel.rows; ++k)
      problem.right_side[i] += problem.kernel(k, i) * problem.readings[k];
    for (std::size_t j = 0; j < problem.matrix.columns; ++j) {
      double sum = problem.stabiliser(i, j);
      for (std::size_t k = 0; k < problem.kernel.rows; ++k)
        sum += problem.kernel(k, i) * problem.kernel(k, j);
      problem.matrix(i, j) = sum;
    }
  }
  const std::vector<double> direct = solve_symmetric(problem.matrix, problem.right_side);
  const std::vector<double> rest = steady_state(state_space(
      realize(Realization::lattice, problem, {.opamp = {.gain = 1e10, .bandwidth = 1e7}})));
  for (std::size_t i = 0; i < direct.size(); ++i) CHECK_THAT(rest[i], WithinAbs(direct[i], 1e-7));
}

TEST_CASE("a dead taxel has no residual, and a traction that no taxel sees rests at 0",
          "[lattice]") {
  NetworkProblem problem = array_network(7, 1e-3).problem;
  for (std::size_t j = 0; j < 7; ++j) problem.kernel(3, j) = 0.0;
  const Circuit circuit = realize(Realization::lattice, problem, {.opamp = one_pole});
  CHECK(std::find(circuit.nodes.begin(), circuit.nodes.end(), "u3") == circuit.nodes.end());
  CHECK(circuit.sources.size() == 12);
  CHECK(poles(state_space(FlatCircuit(circuit))).front().real() < 0.0);

  problem = array_network(2, 1e-3).problem;
  for (std::size_t i = 0; i < 2; ++i) {
    problem.kernel(i, 1) = 0.0;
    problem.stabiliser(0, 1) = problem.stabiliser(1, 0) = 0.0;
  }
  const std::vector<double> rest =
      steady_state(state_space(realize(Realization::lattice, problem, {.opamp = one_pole})));
  CHECK(rest[0] > 0.1);
  CHECK_THAT(rest[1], WithinAbs(0.0, 1e-12));
}

TEST_CASE("a lattice settles as it was designed to, and does not ring", "[lattice]") {
  const Certificate coarse =
      certify(Realization::lattice, array_network(21, 1e-3).problem, {.opamp = one_pole});
  REQUIRE(coarse.dynamics);
  CHECK_THAT(coarse.dynamics->settling_seconds.value(), WithinRel(1.38e-6, 0.02));
  CHECK(coarse.dynamics->damping > 0.999);
  CHECK(coarse.theorem.holds());
  CHECK_FALSE(coarse.dynamics->rings);
  const Certificate fine =
      certify(Realization::lattice, array_network(21, 1e-5).problem, {.opamp = one_pole});
  CHECK_THAT(fine.dynamics.value().settling_seconds.value(), WithinRel(70.5e-6, 0.02));
  CHECK(coarse.tolerance_margin.value() > 0.01);
  CHECK_FALSE(coarse.margin_for_any_bandwidth);
  CHECK(coarse.margin_for_one_bandwidth);
}

TEST_CASE("a lattice of parts within 1 % is nearer than other circuits", "[lattice]") {
  const NetworkProblem problem = array_network(21, 1e-3).problem;
  const ToleranceResult lattice = with_parts(problem, 0.01);
  CHECK(lattice.stable == 300);
  CHECK_THAT(lattice.median, WithinRel(3.6e-3, 0.08));
  CHECK_THAT(lattice.predicted, WithinRel(lattice.median, 0.35));
  CHECK(with_parts(problem, 0.05).stable == 300);
}

TEST_CASE("capacitance at a lattice's inputs is answered by a scale that bears it", "[lattice]") {
  const NetworkProblem problem = array_network(21, 1e-3).problem;
  RealizationOptions options{.opamp = one_pole};
  options.opamp.input_capacitance = options.node_capacitance = 1e-12;
  for (const double second_pole : {1e7, 2e7}) {
    options.opamp.second_pole = second_pole;
    options.scale.siemens = 1e-6;
    const Certificate bad = certify(Realization::lattice, problem, options);
    CHECK(bad.stability == Stability::unstable);
    const auto remark = std::find_if(bad.remarks.begin(), bad.remarks.end(), [](const auto& one) {
      return one.kind == CircuitRemark::Kind::floating_input_capacitance;
    });
    REQUIRE(remark != bad.remarks.end());
    options.scale.siemens = remark->repair;
    const Certificate good = certify(Realization::lattice, problem, options);
    CHECK(good.stability == Stability::stable);
    CHECK_FALSE(good.theorem.holds());  // found, not proven
  }
}

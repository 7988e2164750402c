// A circuit of parts that are off as the inner solver of a refinement: what theorem T9 promises of
// every build, what builds do, and what is refused.
#include "tactile_net/network/refinement.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

/// Its largest voltage is 1 V.
NetworkCircuit circuit_of(Realization realization, const NetworkProblem& problem,
                          std::span<const double> direct, const OpAmp& opamp = {}) {
  double largest = 0.0;
  for (const double f : direct) largest = std::max(largest, std::abs(f));
  return {realization,
          std::make_shared<const NetworkProblem>(problem),
          {.scale = {.volts = 1.0 / largest}, .opamp = opamp}};
}

NetworkCircuit circuit_of(Realization realization, std::size_t taxels, double alpha,
                          const OpAmp& opamp = {}) {
  const ArrayNetwork array = array_network(taxels, alpha);
  return circuit_of(realization, array.problem, array.direct, opamp);
}

/// K of any entries and a stabiliser, with readings of either sign.
NetworkProblem random_problem(std::mt19937& generator) {
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(generator()) / 4294967295.0;
  };
  const std::size_t n = 3 + generator() % 5;
  const std::size_t m = n + generator() % 3;
  NetworkProblem problem{.kernel = {m, n, {}}};
  for (std::size_t k = 0; k < m * n; ++k) problem.kernel.values.push_back(between(-1.0, 1.0));
  problem.stabiliser = random_definite(n, static_cast<unsigned>(generator()));
  const double alpha = std::pow(10.0, between(-3.0, 0.0));
  for (double& r : problem.stabiliser.values) r *= alpha;
  for (std::size_t i = 0; i < m; ++i) problem.readings.push_back(between(-1.0, 1.0));
  const auto k = view(problem.kernel);
  const RowMajor p = k.transpose() * k + view(problem.stabiliser);
  const Eigen::VectorXd b = k.transpose() * view(problem.readings);
  problem.matrix = {n, n, {p.data(), p.data() + p.size()}};
  for (std::size_t i = 0; i < n; ++i)  // to the last bit
    for (std::size_t j = 0; j < i; ++j) problem.matrix(i, j) = problem.matrix(j, i);
  problem.right_side = {b.begin(), b.end()};
  return problem;
}

constexpr RefinementOptions exact(RefinementStep step, std::size_t cycles = 5) {
  return {.converters = std::nullopt, .cycles = cycles, .step = step};
}

/// The largest share of the error's energy that a cycle leaves, while arithmetic has room.
double slowest(const Refined& refined) {
  double most = 0.0;
  for (std::size_t k = 1; k < refined.energies.size() && refined.energies[k - 1] > 1e-9; ++k)
    most = std::max(most, refined.energies[k] / refined.energies[k - 1]);
  return most;
}

/// The same if each step had gone half as far again.
double slowest_beyond(const Refined& refined, const NetworkProblem& problem) {
  const auto p = view(problem.matrix);
  const Eigen::VectorXd end = view(refined.tractions.back());
  const auto energy = [&](const Eigen::VectorXd& f) {
    const Eigen::VectorXd e = f - end;
    return std::sqrt(e.dot(p * e));
  };
  const Eigen::VectorXd from = view(refined.tractions[0]);
  const Eigen::VectorXd to = view(refined.tractions[1]);
  return energy(from + 1.5 * (to - from)) / energy(from);
}

}  // namespace

TEST_CASE("no build within the tolerances converges more slowly than theorem T9 says",
          "[refinement]") {
  std::mt19937 generator(1);
  int tried = 0;
  int wrong_steps_seen = 0;
  double nearest = 0.0;
  constexpr Realization all[] = {Realization::crossbar, Realization::least_squares,
                                 Realization::lattice};
  while (tried < 300) {
    const NetworkProblem problem = random_problem(generator);
    const NetworkCircuit circuit(all[generator() % 3],
                                 std::make_shared<const NetworkProblem>(problem), {});
    const double tolerance = std::pow(10.0, -3.5 + 2.7 * static_cast<double>(generator()) / 4.3e9);
    const ToleranceOptions tolerances{.relative = tolerance, .seed = generator()};
    const Refinement search(circuit, tolerances, exact(RefinementStep::search, 16));
    const double t = search.bound().parts;
    if (t > 0.95) continue;
    ++tried;
    CAPTURE(name(circuit.realization()), tolerance, t, tried);
    const std::vector<double> adverse = search.adverse_siemens();
    for (std::size_t r = 0; r < adverse.size(); ++r) {
      const double off = circuit.reduction().siemens()[r] / adverse[r] - 1.0;
      REQUIRE(std::abs(off) <= tolerance * (1.0 + 1e-9));
    }
    const Refinement plain(circuit, tolerances, exact(RefinementStep::plain));
    const Refinement conjugate(circuit, tolerances, exact(RefinementStep::conjugate));
    const double room = 1.0 + 1e-6;
    for (const bool conspire : {false, true}) {
      const Refined one = conspire ? search.build(adverse) : search.build(0);
      REQUIRE(one.deviation <= t * room);
      REQUIRE(slowest(one) <= t * room);
      nearest = std::max(nearest, slowest(one) / t);
      if (slowest_beyond(one, problem) > t) ++wrong_steps_seen;
      const Refined along = conspire ? conjugate.build(adverse) : conjugate.build(0);
      REQUIRE(slowest(along) <= t * room);
      if (t >= 0.5) continue;
      const Refined whole = conspire ? plain.build(adverse) : plain.build(0);
      REQUIRE(slowest(whole) <= t / (1.0 - t) * room);
    }
  }
  // It is sharp enough to tell a step that is wrong.
  CHECK(wrong_steps_seen > tried / 2);
  CHECK(nearest > 0.4);
}

TEST_CASE("a lattice of 41 taxels with parts of 1 % comes to six digits in four cycles",
          "[refinement]") {
  const NetworkCircuit circuit =
      circuit_of(Realization::lattice, 41, 1e-3, {.gain = 1e6, .offset = 5e-5});
  const ToleranceOptions tolerances{.relative = 0.01, .trials = 100, .seed = 3};
  const Refinement refinement(circuit, tolerances, {.cycles = 5});
  const RefinementBound bound = refinement.bound();
  CHECK_THAT(bound.kernel + bound.stabiliser, WithinRel(0.176, 0.02));
  CHECK_THAT(bound.condition, WithinRel(22.0, 0.03));
  CHECK(bound.parts_of_most < 0.09);
  CHECK(bound.fixed < 1e-3);
  CHECK(bound.fixed > 0.0);  // the op-amps' gain

  const RefinementTrials trials = refinement.trials();
  CHECK(trials.stable == trials.builds);
  CHECK(trials.worst_deviation < 0.03);
  CHECK(trials.worst_deviation < bound.parts_of_most);
  CHECK(trials.adverse_deviation > 0.08);
  CHECK(trials.adverse_deviation < bound.parts);
  CHECK(trials.cycles[0].p95 > 5e-3);
  CHECK(trials.cycles[2].p95 < 2e-6);
  CHECK(trials.cycles[3].p95 < 3e-8);
  CHECK(trials.cycles[3].worst < 1e-6);
  CHECK(trials.cycles[3].adverse < 2e-6);
  CHECK(trials.p95_cycles.value() <= 4);
  // The residual's arithmetic ends it, as measured by an independent program.
  CHECK(trials.single_floor > 1.0e-7 / 3.0);
  CHECK(trials.single_floor < 1.0e-7 * 3.0);
  CHECK(trials.double_floor < 1e-14);

  const RefinementVerdict found = verdict(bound, trials, true);
  CHECK(found == RefinementVerdict::proven);
  const std::size_t proven = proven_cycles(bound, trials, found, 1e-6).value();
  CHECK(proven >= trials.p95_cycles.value());
  CHECK(proven < 15);
  CHECK(verdict(bound, trials, false) == RefinementVerdict::refused);
  CHECK(!proven_cycles(bound, trials, RefinementVerdict::refused, 1e-6));

  // A step of refinement is the board's own error.
  CHECK(trials.self_test.apart < 0.05);
  CHECK_THAT(trials.self_test.limit, WithinRel(trials.cycles[0].p95, 0.1));
}

TEST_CASE("at small alpha K bears refinement, and P does not", "[refinement]") {
  const auto found = [](Realization realization, std::size_t taxels, double tolerance) {
    const NetworkCircuit circuit = circuit_of(realization, taxels, 1e-5);
    const Refinement refinement(circuit, {.relative = tolerance, .trials = 40}, {.cycles = 7});
    const RefinementTrials trials = refinement.trials();
    const RefinementVerdict judged = verdict(refinement.bound(), trials, true);
    return std::pair(judged, trials.p95_cycles.value_or(99));
  };
  using enum Realization;
  CHECK(found(lattice, 41, 0.01) == std::pair(RefinementVerdict::proven_of_most, std::size_t{5}));
  CHECK(found(lattice, 41, 0.005).first == RefinementVerdict::proven);
  const auto few = found(lattice, 21, 0.01);
  CHECK(few.first == RefinementVerdict::proven_of_most);
  CHECK(few.second <= 7);
  CHECK(found(crossbar, 21, 0.01).first == RefinementVerdict::refused);
}

TEST_CASE("of random builds none is beyond the bound of a million", "[refinement]") {
  std::mt19937 generator(5);
  const NetworkProblem problem = random_problem(generator);
  const NetworkCircuit circuit(Realization::least_squares,
                               std::make_shared<const NetworkProblem>(problem), {});
  const Refinement refinement(circuit, {.relative = 0.01}, exact(RefinementStep::search, 1));
  const double most = refinement.bound().parts_of_most;
  double worst = 0.0;
  double worst_of_first = 0.0;
  for (std::size_t trial = 0; trial < 20000; ++trial) {
    worst = std::max(worst, refinement.build(trial).deviation);
    if (trial == 999) worst_of_first = worst;
  }
  CHECK(worst < most);
  CHECK(most < 4.0 * worst_of_first);
  CHECK(most < refinement.bound().parts);
}

TEST_CASE("converters turn a cycle by no more than their share", "[refinement]") {
  const NetworkCircuit circuit = circuit_of(Realization::lattice, 21, 1e-3, {.offset = 5e-5});
  double largest_share = 0.0;
  for (const int bits : {6, 8, 12, 16})
    for (const double gain : {1e-4, 1e-3, 1e-2}) {
      CAPTURE(bits, gain);
      const Converters converters{.bits = bits, .gain = gain, .noise = 1e-4};
      for (const RefinementStep step : {RefinementStep::search, RefinementStep::plain}) {
        const Refinement refinement(circuit, {.relative = 0.01, .seed = 4},
                                    {.converters = converters, .cycles = 6, .step = step});
        const double share = refinement.bound().contraction();
        for (std::size_t trial = 0; trial < 15; ++trial) {
          const double measured = slowest(refinement.build(trial));
          CHECK(measured <= share);
          largest_share = std::max(largest_share, measured / share);
        }
      }
    }
  CHECK(largest_share > 0.02);
  // No converter ends it: each cycle's range is what is left.
  const Refinement coarse(circuit, {.relative = 0.01},
                          {.converters = Converters{.bits = 6}, .cycles = 24});
  CHECK(coarse.build(0).errors.back() < 1e-13);
}

TEST_CASE("refinement's builds are the boards of the other draws", "[refinement]") {
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const NetworkCircuit circuit = circuit_of(one, 8, 1e-3);
    const ToleranceOptions tolerances{.relative = 0.02, .stabiliser = 0.005, .seed = 9};
    const Refinement refinement(circuit, tolerances, exact(RefinementStep::search, 2));
    const Trial board = try_out(circuit.reduction(), drawn(circuit.reduction(), tolerances, 3));
    const Refined refined = refinement.build(3);
    REQUIRE(board.voltages.size() == refined.tractions[0].size());
    const double volts = circuit.options().scale.volts;
    for (std::size_t i = 0; i < board.voltages.size(); ++i)
      CHECK_THAT(refined.tractions[0][i] * volts, WithinAbs(board.voltages[i], 1e-12));
    CHECK_THAT(refined.errors[0], WithinRel(board.error, 1e-6));
    CHECK(refined.errors[1] < 0.2 * refined.errors[0]);
  }
}

TEST_CASE("readings as voltages, values of a series and coarse cells are refined alike",
          "[refinement]") {
  const ArrayNetwork array = array_network(12, 1e-3);
  const auto problem = std::make_shared<const NetworkProblem>(array.problem);
  for (const Realization one : {Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const NetworkCircuit circuit(one, problem, {.inputs = Inputs::voltage});
    for (ToleranceOptions tolerances :
         {ToleranceOptions{.relative = 0.01},
          ToleranceOptions{.relative = 0.01, .series = Series::e96},
          ToleranceOptions{.relative = 0.01, .bits = 6}, ToleranceOptions{.bits = 6}}) {
      tolerances.trials = 20;
      const Refinement refinement(circuit, tolerances, {.cycles = 6});
      const RefinementBound bound = refinement.bound();
      const RefinementTrials trials = refinement.trials();
      CHECK((bound.fixed > 1e-3) == (tolerances.series || tolerances.bits));
      CHECK(trials.worst_deviation <= bound.parts * (1.0 + 1e-9));
      CHECK(verdict(bound, trials, true) == RefinementVerdict::proven);
      CHECK(trials.cycles.back().worst < 1e-7);
    }
  }
}

TEST_CASE("what refinement does not speak of is refused", "[refinement]") {
  const ArrayNetwork array = array_network(6, 1e-3);
  const auto problem = std::make_shared<const NetworkProblem>(array.problem);
  const auto make = [&](Realization realization, const RealizationOptions& parts,
                        const ToleranceOptions& tolerances, const RefinementOptions& options) {
    const NetworkCircuit circuit(realization, problem, parts);
    return Refinement(circuit, tolerances, options);
  };
  using enum Realization;
  const ToleranceOptions one{.relative = 0.01};
  CHECK_NOTHROW(make(lattice, {}, one, {}));
  CHECK_THROWS_AS(make(nic, {}, one, {}), std::invalid_argument);
  CHECK_THROWS_AS(make(crossbar, {.inverters = true}, one, {}), std::invalid_argument);
  CHECK_THROWS_AS(make(least_squares, {.ladder = true}, one, {}), std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, {.relative = 0.01, .cell_noise = 0.01}, {}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, {.relative = 0.01, .balance = 0.01}, {}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, {.relative = 0.01, .common = {.reel = 0.01}}, {}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, one, {.cycles = 0}), std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, one, {.converters = Converters{.bits = 3}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, one, {.converters = Converters{.gain = 0.5}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make(lattice, {}, one, {.accuracy = 0.0}), std::invalid_argument);
  NetworkProblem at_rest = array.problem;
  std::fill(at_rest.readings.begin(), at_rest.readings.end(), 0.0);
  std::fill(at_rest.right_side.begin(), at_rest.right_side.end(), 0.0);
  const NetworkCircuit unloaded(lattice, std::make_shared<const NetworkProblem>(at_rest), {});
  CHECK_THROWS_AS(Refinement(unloaded, one), std::invalid_argument);
}

// Theorems inside their conditions, on random networks; and one network outside of each.
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "tactile_net/network/certificate.hpp"
#include "tests/catch.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double uniform(double least, double greatest) {
    return least + (greatest - least) * static_cast<double>(generator_()) / 4294967295.0;
  }
  /// Even in the logarithm.
  double decades(double least, double greatest) {
    return std::pow(10.0, uniform(std::log10(least), std::log10(greatest)));
  }

 private:
  std::mt19937 generator_;
};

/// More readings than tractions, entries of both signs, a stabiliser that couples neighbours.
NetworkProblem random_problem(Random& random, std::size_t rows, std::size_t columns) {
  NetworkProblem problem;
  problem.kernel = {rows, columns, std::vector<double>(rows * columns)};
  for (double& value : problem.kernel.values) value = random.uniform(-1.0, 1.0);
  const double alpha = random.decades(1e-4, 1e-1);
  problem.stabiliser = {columns, columns, std::vector<double>(columns * columns)};
  for (std::size_t j = 0; j < columns; ++j) {
    problem.stabiliser(j, j) = 3.0 * alpha;
    if (j + 1 < columns) problem.stabiliser(j, j + 1) = problem.stabiliser(j + 1, j) = -alpha;
  }
  problem.matrix = problem.stabiliser;
  problem.readings.assign(rows, 1.0);
  problem.right_side.assign(columns, 0.0);
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t k = 0; k < rows; ++k) {
      problem.right_side[i] += problem.kernel(k, i);
      for (std::size_t j = 0; j < columns; ++j)
        problem.matrix(i, j) += problem.kernel(k, i) * problem.kernel(k, j);
    }
  return problem;
}

NetworkProblem random_network(Random& random, unsigned seed) {
  NetworkProblem problem;
  problem.matrix = random_definite(3 + seed % 4, seed + 1, random.decades(1e-4, 1e-1));
  problem.right_side.assign(problem.matrix.rows, 1.0);
  return problem;
}

OpAmp opamp(std::optional<double> second_pole, std::optional<double> capacitance,
            double gain = 1e9) {
  return {.gain = gain,
          .bandwidth = bandwidth,
          .second_pole = second_pole,
          .input_capacitance = capacitance};
}

/// Stable, and the theorem says so; or the theorem does not speak.
bool certified(Realization one, const NetworkProblem& problem, const RealizationOptions& options) {
  const Certificate c = certify(one, problem, options);
  CHECK((!c.theorem.holds() || c.stability == Stability::stable));
  return c.theorem.holds();
}

constexpr unsigned networks = 200;

double slowest_pole(const Circuit& circuit) {
  return poles(state_space(FlatCircuit(circuit))).front().real();
}

/// From far less than any op-amp has.
double any_gain(Random& random) { return random.decades(1.0, 1e9); }

/// P = [1, s H; s H, 1], H of 1 beside a diagonal of -1: definite for s < 1/2, and what comes of
/// its entries above 0 alone is not.
NetworkProblem opposed_network(double s) {
  NetworkProblem problem{.matrix = {8, 8, std::vector<double>(64)},
                         .right_side = std::vector<double>(8, 1.0)};
  for (std::size_t i = 0; i < 8; ++i) {
    problem.matrix(i, i) = 1.0;
    for (std::size_t j = 0; j < 8; ++j)
      if ((i < 4) != (j < 4)) problem.matrix(i, j) = i % 4 == j % 4 ? -s : s;
  }
  return problem;
}

/// What a remark proposes is within the theorem.
void check_proposals(const NetworkProblem& problem, RealizationOptions options,
                     const CircuitRemark& remark) {
  if (remark.limit > 0.0) {
    RealizationOptions slower = options;
    slower.bandwidth_ratio = 0.999 * remark.limit;
    CHECK(certified(Realization::least_squares, problem, slower));
  }
  if (remark.repair > 0.0) {
    options.scale.siemens = 1.001 * remark.repair;
    CHECK(certified(Realization::least_squares, problem, options));
  }
}

/// Calls with what draws, and a network each.
void for_each_network(unsigned first, const auto& use) {
  Random random(first);
  for (unsigned seed = 0; seed < networks; ++seed) {
    CAPTURE(seed);
    use(random, random_network(random, seed));
  }
}

}  // namespace

TEST_CASE("T5: a crossbar bears second poles, and capacitance where they are not slow",
          "[theorems][property]") {
  for_each_network(1, [&](Random& random, const NetworkProblem& problem) {
    const double gain = any_gain(random);
    CHECK(certified(Realization::crossbar, problem,
                    {.opamp = opamp(bandwidth * random.decades(1e-2, 1e2), std::nullopt, gain)}));
    CHECK(certified(
        Realization::crossbar, problem,
        {.opamp = opamp(bandwidth * random.decades(1.0, 1e2), random.decades(1e-13, 1e-9), gain)}));
  });
  // Slow second poles and capacitance: one that is unstable.
  RealizationOptions slow{.opamp = opamp(0.01 * bandwidth, 1e-10)};
  const NetworkProblem problem = array_network(11, 1e-2).problem;
  CHECK(certify(Realization::crossbar, problem, slow).stability == Stability::unstable);
}

TEST_CASE("T3: with inverters a crossbar bears any capacitance and any gain that both kinds have",
          "[theorems][property]") {
  for_each_network(7, [&](Random& random, const NetworkProblem& problem) {
    const RealizationOptions options{.opamp = opamp(std::nullopt, std::nullopt, any_gain(random)),
                                     .inverters = true,
                                     .bandwidth_ratio = random.decades(1e-2, 0.5)};
    CHECK(certified(Realization::crossbar, problem, options));
    Circuit circuit = realize(Realization::crossbar, problem, options);
    for (const Instance& x : circuit.instances)
      if (x.subcircuit != "inverter")
        circuit.capacitors.push_back({"C" + x.name, x.pins[1], 0, random.decades(1e-14, 1e-8)});
    CHECK(slowest_pole(circuit) < 0.0);
  });

  // Beyond half the inverters' bandwidth, and with more gain than they have: unstable.
  const NetworkProblem opposed = opposed_network(0.4999);
  RealizationOptions options{.opamp = opamp(std::nullopt, std::nullopt, 10.0), .inverters = true};
  CHECK(certified(Realization::crossbar, opposed, options));
  const auto with_gains = [&](double main, double inverters) {
    Circuit circuit = realize(Realization::crossbar, opposed, options);
    for (AmplifierModel& model : circuit.amplifiers)
      model.opamp.gain = model.name == "opamp" ? inverters : main;
    return slowest_pole(circuit);
  };
  CHECK(with_gains(10.0, 1e9) < 0.0);
  CHECK(with_gains(1e9, 10.0) > 0.0);
  options.opamp.gain = 1e9;
  options.bandwidth_ratio = 10.0;
  const Certificate fast = certify(Realization::crossbar, opposed, options);
  CHECK_FALSE(fast.theorem.holds());
  CHECK(fast.stability == Stability::unstable);
}

TEST_CASE("T2: op-amps of one bandwidth and one gain make a rail stable", "[theorems][property]") {
  for_each_network(8, [&](Random& random, const NetworkProblem& problem) {
    CHECK(certified(Realization::rail, problem,
                    {.opamp = opamp(std::nullopt, std::nullopt, any_gain(random)),
                     .node_capacitance = random.decades(1e-14, 1e-9)}));
  });
}

TEST_CASE("what finite gain adds makes up for a P that is barely not definite",
          "[theorems][property]") {
  Random random(9);
  for (unsigned seed = 0; seed < 20; ++seed) {
    NetworkProblem problem = random_network(random, seed);
    const double shift = smallest_eigenvalue(problem.matrix) + 1e-3;
    for (std::size_t i = 0; i < problem.matrix.rows; ++i) problem.matrix(i, i) -= shift;
    for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar}) {
      CAPTURE(seed, name(one));
      const auto at = [&](double gain) {
        return certify(
            one, problem,
            {.opamp = opamp(std::nullopt, std::nullopt, gain), .node_capacitance = 1e-12});
      };
      const Certificate high = at(1e9);
      const Certificate low = at(10.0);
      CHECK(high.dynamics.value().slowest > 0.0);
      CHECK(low.dynamics.value().slowest < 0.0);
      for (const Certificate& c : {high, low}) {
        CHECK(c.stability == Stability::not_definite);
        CHECK_FALSE(c.theorem.holds());
      }
    }
  }
}

TEST_CASE("T1: converters bear second poles, and capacitance at their inputs up to 1/(2 W r)",
          "[theorems][property]") {
  for_each_network(2, [&](Random& random, const NetworkProblem& problem) {
    const double divider = 1e4;
    const double capacitance = random.decades(1e-3, 0.4999) / (angular_bandwidth * divider);
    CHECK(certified(Realization::nic, problem,
                    {.opamp = opamp(std::nullopt, capacitance),
                     .divider = divider,
                     .node_capacitance = random.decades(1e-13, 1e-10)}));
    const double second_pole = bandwidth * random.decades(1e-2, 1e2);
    CHECK(certified(Realization::nic, problem,
                    {.opamp = opamp(second_pole, std::nullopt, any_gain(random)),
                     .node_capacitance = random.decades(1e-13, 1e-10)}));
  });
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  CHECK(certify(Realization::nic, problem,
                {.opamp = opamp(std::nullopt, 20.0 / (angular_bandwidth * 1e4)),
                 .node_capacitance = 1e-11})
            .stability == Stability::unstable);
}

TEST_CASE("T1: with finite gain the bound is where a converter ceases to be positive real",
          "[theorems]") {
  const NetworkProblem problem = array_network(3, 1e-3).problem;
  for (const double gain : {1.0, 10.0, 1e6}) {
    CAPTURE(gain);
    OpAmp real = opamp(std::nullopt, 1e-12);
    real.gain = gain;
    const auto holds = [&](double divider) {
      return certify(Realization::nic, problem, {.opamp = real, .divider = divider})
          .theorem.holds();
    };
    // In units of 1/(W c).
    const double unit = 1.0 / (angular_bandwidth * 1e-12);
    double inside = 0.1;
    double outside = 1.0;
    REQUIRE(holds(inside * unit));
    REQUIRE_FALSE(holds(outside * unit));
    while (outside - inside > 1e-4) {
      const double middle = 0.5 * (inside + outside);
      (holds(middle * unit) ? inside : outside) = middle;
    }
    // Re Y(jw) - Y(0) of docs/circuits.md, W = 1: over w^2 at small w, where it is least.
    const auto real_part = [&](double x, double k) {
      const std::complex<double> s(0.0, 1e-3);
      const auto admittance = [&](std::complex<double> at) {
        return 1.0 - (k + x * at) / (1.0 + (k + x * at) * (at + 1.0 / gain));
      };
      return (admittance(s).real() - admittance(0.0).real()) / 1e-6;
    };
    for (const double k : {1.0, 2.0, 3.0}) CHECK(real_part(0.99 * inside, k) > 0.0);
    CHECK(real_part(1.01 * outside, 1.0) < 0.0);
  }
}

TEST_CASE("T6: least squares bears the lag that its number allows", "[theorems][property]") {
  Random random(3);
  unsigned spoken = 0;
  for (unsigned seed = 0; seed < networks; ++seed) {
    CAPTURE(seed);
    const std::size_t columns = 3 + seed % 4;
    const NetworkProblem problem = random_problem(random, columns + seed % 3, columns);
    RealizationOptions options{.opamp = opamp(bandwidth * random.decades(1.0, 1e3),
                                              random.decades(1e-15, 1e-11), any_gain(random)),
                               .residual_gain = random.decades(0.3, 30.0),
                               .bandwidth_ratio = random.decades(1e-2, 1.0)};
    if (certified(Realization::least_squares, problem, options)) {
      ++spoken;
      continue;
    }
    const Certificate c = certify(Realization::least_squares, problem, options);
    const auto remark = std::find_if(c.remarks.begin(), c.remarks.end(), [](const auto& one) {
      return one.kind == CircuitRemark::Kind::summing_lag;
    });
    REQUIRE(remark != c.remarks.end());
    CHECK(remark->value == c.theorem.unmet.value().lag.number);
    check_proposals(problem, options, *remark);
  }
  CHECK(spoken > 40);
  CHECK(spoken < 180);
  // Op-amps as they are sold, on the array as it is: the default gain is unstable.
  const Certificate bought = certify(Realization::least_squares, array_network(21, 1e-3).problem,
                                     {.opamp = opamp(2.0 * bandwidth, std::nullopt)});
  CHECK(bought.stability == Stability::unstable);
  CHECK_THAT(bought.dynamics.value().slowest, WithinRel(6.0e6, 0.05));
  CHECK(bought.theorem.unmet.value().condition == TheoremCondition::lag_within_bound);
  // design: proven up to W tau = 0.026 here, so 0.5 / 0.026 = 19 times too much or somewhat more
  CHECK(bought.theorem.unmet->lag.number > 19.0);
}

TEST_CASE("T7: a lattice bears any second poles, or any capacitance at its residuals",
          "[theorems][property]") {
  Random random(4);
  for (unsigned seed = 0; seed < networks; ++seed) {
    CAPTURE(seed);
    const std::size_t columns = 3 + seed % 4;
    const NetworkProblem problem = random_problem(random, columns + seed % 3, columns);
    const double gain = any_gain(random);
    CHECK(certified(Realization::lattice, problem,
                    {.opamp = opamp(bandwidth * random.decades(1e-2, 1e2), std::nullopt, gain)}));
    CHECK(certified(Realization::lattice, problem,
                    {.opamp = opamp(std::nullopt, std::nullopt, gain),
                     .node_capacitance = random.decades(1e-14, 1e-8)}));
  }
  // Capacitance at the inputs and as much at the residuals is outside, and unstable.
  CHECK(certify(Realization::lattice, array_network(21, 1e-3).problem,
                {.opamp = opamp(bandwidth, 1e-9), .node_capacitance = 1e-9})
            .stability == Stability::unstable);
}

TEST_CASE("T7: a lattice bears any capacitance at its inputs, with second poles of 2 W or more",
          "[theorems][property]") {
  Random random(6);
  for (unsigned seed = 0; seed < networks; ++seed) {
    CAPTURE(seed);
    const std::size_t columns = 1 + seed % 5;
    const NetworkProblem problem = random_problem(random, columns + seed % 3, columns);
    OpAmp real = opamp(bandwidth * random.decades(2.0, 20.0), random.decades(1e-14, 1e-9));
    real.gain = random.decades(1e2, 1e9);
    CHECK(certified(Realization::lattice, problem, {.opamp = real}));
    real.differential_capacitance = random.decades(1e-14, 1e-9);
    CHECK(certified(Realization::lattice, problem, {.opamp = real}));
    real.second_pole.reset();
    CHECK(certified(Realization::lattice, problem, {.opamp = real}));
  }
  // The factor 2 is sharp: one reading of one traction.
  const NetworkProblem one{.matrix = {1, 1, {1.1}},
                           .right_side = {1.0},
                           .kernel = {1, 1, {1.0}},
                           .stabiliser = {1, 1, {0.1}},
                           .readings = {1.0}};
  const auto at = [&](double poles, double farad) {
    return certify(Realization::lattice, one, {.opamp = opamp(poles * bandwidth, farad)});
  };
  CHECK(at(2.0, 1e-8).theorem.holds());
  CHECK(at(2.0, 1e-8).stability == Stability::stable);
  CHECK_FALSE(at(1.9, 1e-8).theorem.holds());
  CHECK(at(1.9, 1e-8).stability == Stability::unstable);
  // From C = d/(2 W - W2) on, d = k: the answer's own conductance, c/(1 + c) b + w R.
  double least = 1e-12;
  double most = 1e-8;
  while (most > 1.0001 * least) {
    const double middle = std::sqrt(least * most);
    (at(1.5, middle).stability == Stability::stable ? least : most) = middle;
  }
  const double d = 1e-3 * 0.8 * 1.1;
  CHECK_THAT(most, WithinRel(d / (0.5 * angular_bandwidth), 1e-3));
}

TEST_CASE(
    "T6L: a ladder bears any gain and ratio of bandwidths, and the lag that its number allows",
    "[theorems][property]") {
  Random random(5);
  unsigned spoken = 0;
  for (unsigned seed = 0; seed < networks; ++seed) {
    CAPTURE(seed);
    const std::size_t columns = 3 + seed % 4;
    const NetworkProblem problem = random_problem(random, columns + seed % 3, columns);
    const double gain = any_gain(random);
    RealizationOptions options{.opamp = opamp(std::nullopt, std::nullopt, gain),
                               .residual_gain = random.decades(0.1, 1e3),
                               .ladder = true,
                               .bandwidth_ratio = random.decades(1e-2, 1e2)};
    CHECK(certified(Realization::least_squares, problem, options));
    options.residual_gain = random.decades(0.3, 30.0);
    options.bandwidth_ratio = random.decades(1e-2, 1.0);
    const bool of_nodes = seed % 2 == 0;
    if (of_nodes)
      options.node_capacitance = random.decades(1e-13, 1e-9);
    else
      options.opamp =
          opamp(bandwidth * random.decades(1.0, 1e3), random.decades(1e-13, 1e-9), gain);
    if (certified(Realization::least_squares, problem, options)) {
      ++spoken;
      continue;
    }
    const Certificate c = certify(Realization::least_squares, problem, options);
    CHECK(c.theorem.unmet.value().condition == TheoremCondition::lag_within_bound);
    const auto kind = of_nodes ? CircuitRemark::Kind::node_lag : CircuitRemark::Kind::summing_lag;
    const auto remark = std::find_if(c.remarks.begin(), c.remarks.end(),
                                     [&](const auto& one) { return one.kind == kind; });
    REQUIRE(remark != c.remarks.end());
    check_proposals(problem, options, *remark);
  }
  CHECK(spoken > 40);
  CHECK(spoken < 180);
}

TEST_CASE("T6L: one ladder outside of each of its conditions is unstable", "[theorems]") {
  const NetworkProblem problem = array_network(21, 1e-5).problem;
  const auto unmet = [&](const OpAmp& op, std::optional<double> node) {
    const Certificate c = certify(Realization::least_squares, problem,
                                  {.opamp = op, .ladder = true, .node_capacitance = node});
    CHECK(c.stability == Stability::unstable);
    return c.theorem.unmet.value().condition;
  };
  CHECK(unmet(opamp(2.0 * bandwidth, std::nullopt), {}) == TheoremCondition::lag_within_bound);
  CHECK(unmet(opamp({}, 1e-9), {}) == TheoremCondition::lag_within_bound);
  CHECK(unmet(opamp({}, {}), 1e-11) == TheoremCondition::lag_within_bound);
  CHECK(unmet(opamp(2.0 * bandwidth, {}), 1e-11) == TheoremCondition::one_lag);
  OpAmp behind = opamp({}, 1e-12);
  behind.input_capacitance.reset();
  behind.output_resistance = 10.0;
  CHECK(certify(Realization::least_squares, problem, {.opamp = behind, .ladder = true})
            .theorem.unmet.value()
            .condition == TheoremCondition::no_output_resistance);

  // Bandwidths a hundred times up and down among the main amplifiers and among the residuals'.
  unsigned unstable = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Random random(seed);
    Circuit circuit =
        realize(Realization::least_squares, problem, {.opamp = opamp({}, {}), .ladder = true});
    const AmplifierModel model = circuit.amplifiers.front();
    circuit.amplifiers.clear();
    for (Instance& x : circuit.instances) {
      x.subcircuit = "a" + std::to_string(circuit.amplifiers.size());
      circuit.amplifiers.push_back(model);
      circuit.amplifiers.back().name = x.subcircuit;
      circuit.amplifiers.back().opamp.bandwidth = bandwidth * random.decades(1e-2, 1e2);
    }
    if (slowest_pole(circuit) > 0.0) ++unstable;
  }
  CHECK(unstable > 0);
}

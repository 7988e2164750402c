// A board on the bench: the part that is wrong is named, healthy boards are not accused, and the
// correction makes its answer exact.
#include "tactile_net/network/board_bench.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>

#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

/// A lattice to be soldered: eight taxels, op-amps of 100 dB and 0.2 mV.
struct Bench {
  explicit Bench(Realization realization = Realization::lattice, std::size_t taxels = 8)
      : network(array_network(taxels, 1e-3)),
        circuit(realize(realization, network.problem,
                        {.opamp = {.gain = 1e5, .bandwidth = 1e7, .offset = 2e-4}})),
        flat(circuit),
        reduction(flat),
        model(reduction, board_inputs(circuit.sources),
              std::vector<double>(reduction.resistors().size(), 0.01)),
        currents(model.single_inputs(1.0)) {}

  /// Parts of 1 %.
  [[nodiscard]] std::vector<double> built(std::uint64_t seed) const {
    return drawn(reduction, {.relative = 0.01, .seed = seed}, 0);
  }
  [[nodiscard]] BoardResponses measured(const std::vector<double>& siemens,
                                        std::uint64_t seed) const {
    return simulated_responses(flat, model.inputs(), siemens, currents, 12, 1.1, seed);
  }
  ArrayNetwork network;
  Circuit circuit;
  FlatCircuit flat;
  Reduction reduction;
  BoardModel model;
  Matrix currents;
};

/// One of the kinds, anywhere.
BoardFault any_fault(const Bench& bench, std::mt19937& generator) {
  constexpr PartFault kinds[] = {PartFault::open, PartFault::ten_times, PartFault::tenth,
                                 PartFault::swapped};
  const std::size_t parts = bench.reduction.resistors().size();
  BoardFault fault{.kind = kinds[generator() % 4], .part = generator() % parts};
  if (fault.kind == PartFault::ten_times) fault.factor = 0.1;
  if (fault.kind == PartFault::tenth) fault.factor = 10.0;
  if (fault.kind == PartFault::swapped) fault.other = generator() % parts;
  return fault;
}

bool same_fault(const BoardFault& a, const BoardFault& b) {
  return a.kind == b.kind &&
         ((a.part == b.part && a.other == b.other) ||
          (a.kind == PartFault::swapped && a.part == b.other && a.other == b.part));
}

/// How far corrected voltages are from the exact ones, of the board itself without noise.
double error_behind(const Bench& bench, const std::vector<double>& siemens,
                    const BoardDiagnosis& found) {
  const BoardResponses is =
      simulated_responses(bench.flat, bench.model.inputs(), siemens, bench.currents, 40, 100.0, 1);
  const Matrix exact = bench.model.exact(bench.currents);
  return (view(is.voltages) * view(found.correction).transpose() - view(exact)).norm() /
         view(exact).norm();
}

struct Tally {
  int visible = 0, found = 0, few = 0;
};

/// Of planted faults those that the responses of an otherwise exact board show, and of these the
/// ones that are named on a board of 1 % parts.
Tally tally(const Bench& bench, int boards, unsigned seed) {
  std::mt19937 generator(seed);
  const std::vector<double> nominal(bench.reduction.siemens().begin(),
                                    bench.reduction.siemens().end());
  Tally result;
  for (unsigned k = 0; result.visible < boards; ++k) {
    const BoardFault fault = any_fault(bench, generator);
    const BoardDiagnosis alone =
        bench.model.diagnose(bench.measured(with_fault(nominal, fault), k));
    if (alone.candidates.front().evidence < 2.0 * alone.needed) continue;
    ++result.visible;
    const BoardDiagnosis found =
        bench.model.diagnose(bench.measured(with_fault(bench.built(seed + k), fault), k));
    const auto end = found.candidates.begin() + static_cast<std::ptrdiff_t>(found.named);
    if (std::none_of(found.candidates.begin(), end,
                     [&](const auto& one) { return same_fault(one.fault, fault); }))
      continue;
    ++result.found;
    if (found.named <= 4) ++result.few;
  }
  return result;
}

}  // namespace

TEST_CASE("a planted fault is named among parts of 1 % by responses of 12 bits", "[bench]") {
  // Open, swapped and wrong decade. The two resistors of a pair do the same, and are told together.
  const Tally lattice = tally(Bench(), 100, 1);
  CHECK(lattice.found >= 95);
  CHECK(lattice.few >= 95);
  for (const Realization one : {Realization::crossbar, Realization::least_squares}) {
    CAPTURE(name(one));
    CHECK(tally(Bench(one), 25, 2).found >= 24);
  }
}

TEST_CASE("a healthy board is not accused, and its correction makes it exact", "[bench]") {
  const Bench bench;
  int accused = 0;
  double worst = 0.0;
  double squares = 0.0;
  for (unsigned k = 0; k < 100; ++k) {
    const std::vector<double> siemens = bench.built(100 + k);
    const BoardDiagnosis found = bench.model.diagnose(bench.measured(siemens, k));
    if (found.named > 0) ++accused;
    const double before = error_behind(bench, siemens, {.correction = [] {
                                         Matrix unit{8, 8, std::vector<double>(64)};
                                         for (std::size_t i = 0; i < 8; ++i) unit(i, i) = 1.0;
                                         return unit;
                                       }()});
    CHECK_THAT(found.error, WithinRel(before, 0.1));
    worst = std::max(worst, error_behind(bench, siemens, found));
    squares += found.misfit * found.misfit / 100.0;
  }
  CHECK(accused <= 5);
  CHECK(worst < 1e-3);  // from 1 %
  CHECK_THAT(squares, WithinRel(1.0, 0.05));
}

TEST_CASE("a board with a fault is corrected, too", "[bench]") {
  const Bench bench;
  const auto at =
      std::find(bench.reduction.resistors().begin(), bench.reduction.resistors().end(), "Rk3_3p");
  REQUIRE(at != bench.reduction.resistors().end());
  const BoardFault open{.kind = PartFault::open,
                        .part = static_cast<std::size_t>(at - bench.reduction.resistors().begin())};
  const std::vector<double> siemens = with_fault(bench.built(3), open);
  const BoardDiagnosis found = bench.model.diagnose(bench.measured(siemens, 3));
  REQUIRE(found.named == 2);  // and its twin, Rk3_3n
  CHECK(found.misfit > 3.0);
  CHECK_THAT(found.misfit_with_fault, WithinAbs(1.0, 0.3));
  CHECK(found.error > 0.02);
  CHECK(error_behind(bench, siemens, found) < 2e-3);
}

TEST_CASE("a bench knows what parts are from responses that many know", "[bench][property]") {
  // Each input, then pairs of them: the errors of what counts are seen.
  Bench bench;
  const std::vector<double> siemens = bench.built(5);
  const BoardDiagnosis found = bench.model.diagnose(bench.measured(siemens, 5));
  REQUIRE(found.part_errors.size() == bench.reduction.resistors().size());
  double squares = 0.0;
  double gain = 0.0;
  for (std::size_t r = 0; r < siemens.size(); ++r) {
    const double truth = std::log(siemens[r] / bench.reduction.siemens()[r]);
    squares += std::pow((found.part_errors[r] - truth) / found.part_deviations[r], 2);
    gain += std::pow(truth, 2) - std::pow(found.part_errors[r] - truth, 2);
    CHECK(found.part_deviations[r] <= 0.01 / std::sqrt(3.0) * (1.0 + 1e-9));
  }
  CHECK_THAT(squares / static_cast<double>(siemens.size()), WithinAbs(1.0, 0.15));
  CHECK(gain > 0.0);
}

TEST_CASE("inputs are sources, pairs of them where a reading is a pair", "[bench]") {
  const Bench bench;
  CHECK(bench.model.inputs().size() == 8);
  CHECK(bench.model.inputs()[3].name == "I3");
  CHECK(bench.model.inputs()[3].per_ampere.size() == 2);
  // As the circuit's own sources have it: the same answer.
  Matrix own{1, 8, std::vector<double>(8)};
  for (std::size_t i = 0; i < 8; ++i) own(0, i) = bench.circuit.sources[2 * i + 1].ampere;
  const Matrix exact = bench.model.exact(own);
  Equations equations = bench.reduction.equations();
  const Eigen::VectorXd z = view(equations.matrix)
                                .partialPivLu()
                                .solve(view(std::span<const double>(equations.right_side)));
  CHECK((view(exact).transpose() - z.head(8)).norm() < 1e-9 * z.head(8).norm());
  CHECK(board_inputs(Bench(Realization::crossbar).circuit.sources).front().per_ampere.size() == 1);
}

TEST_CASE("what a bench cannot use is refused", "[bench]") {
  const Bench bench;
  BoardResponses good = bench.measured(bench.built(1), 1);
  const auto refused = [&](const BoardResponses& responses) {
    CHECK_THROWS_AS(bench.model.diagnose(responses), std::invalid_argument);
  };
  BoardResponses bad = good;
  bad.noise = 0.0;
  refused(bad);
  bad = good;
  bad.currents.rows = 7;
  bad.currents.values.resize(56);
  refused(bad);
  bad = good;
  bad.voltages(0, 0) = std::numeric_limits<double>::infinity();
  refused(bad);
  bad = good;
  for (double& one : bad.voltages.values) one = std::nan("");
  refused(bad);
  // Some are missing: it goes without them.
  bad = good;
  for (std::size_t i = 0; i < 8; ++i) bad.voltages(i, 7 - i) = std::nan("");
  CHECK(bench.model.diagnose(bad).named == 0);
  const Circuit with_inverters =
      realize(Realization::crossbar, bench.network.problem, {.inverters = true});
  const Reduction reduction{FlatCircuit(with_inverters)};
  CHECK_THROWS_AS(BoardModel(reduction, board_inputs(with_inverters.sources),
                             std::vector<double>(reduction.resistors().size(), 0.01)),
                  std::invalid_argument);
}

TEST_CASE("a board's own converters show its error by a step of refinement", "[bench][self_test]") {
  const ArrayNetwork network = array_network(21, 1e-3);
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    const Circuit circuit = realize(one, network.problem, {});
    const Reduction reduction{FlatCircuit(circuit)};
    const std::vector<double> tolerances(reduction.resistors().size(), 0.01);
    const SelfTest test = self_test(reduction, network.problem.matrix, network.problem.right_side,
                                    tolerances, 200, 1);
    const ToleranceResult drawn = tolerate(reduction, {.relative = 0.01, .trials = 200, .seed = 1});
    CHECK_THAT(test.limit, WithinRel(drawn.p95, one == Realization::crossbar ? 0.15 : 0.05));
    CHECK_THAT(test.median, WithinRel(drawn.median, 0.05));
    CHECK(test.apart < (one == Realization::crossbar ? 0.2 : 0.05));
  }
}

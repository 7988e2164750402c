// Arrays that are programmed instead of soldered, and arrays whose lines are wires.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "network/wired_array.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/network/wired.hpp"

using namespace tactile_net;

namespace {

ToleranceResult study(Realization one, const NetworkProblem& problem,
                      const ToleranceOptions& options, double siemens = 1e-3) {
  return tolerate(Reduction(realize(one, problem, {.scale = {siemens, 1.0}})), options);
}

/// A realisation whose arrays have lines that may be wires.
struct Form {
  Realization realization;
  bool ladder = false;
};
constexpr Form forms[] = {{Realization::crossbar},
                          {Realization::least_squares},
                          {Realization::least_squares, true},
                          {Realization::lattice}};

Circuit circuit_of(const Form& form, const NetworkProblem& problem, double siemens = 1e-3) {
  return realize(form.realization, problem, {.scale = {siemens, 1.0}, .ladder = form.ladder});
}

/// Of a circuit with wires in it, every path through them counted.
double wired_error(const Circuit& circuit, double ohm) {
  const auto at_rest = [](const Circuit& one) { return operating_voltages(FlatCircuit(one)); };
  Circuit exact = circuit;
  for (AmplifierModel& model : exact.amplifiers) model.opamp = {.gain = 1e10};
  return relative_l2_error(at_rest(with_wires(exact, ohm)), at_rest(exact));
}

}  // namespace

TEST_CASE("arrays of so many bits err as was measured before they were built", "[programmed]") {
  struct Row {
    Realization realization;
    std::size_t count;
    double alpha;
    std::vector<std::pair<int, double>> errors;
  };
  const std::vector<Row> table = {
      {Realization::least_squares,
       21,
       1e-3,
       {{4, 5e-2}, {6, 1.2e-2}, {8, 2.4e-3}, {10, 5e-4}, {12, 9e-5}}},
      {Realization::least_squares, 81, 1e-5, {{6, 1.2e-2}, {8, 3.4e-3}}},
      {Realization::crossbar, 21, 1e-3, {{8, 2e-2}, {10, 6e-3}, {12, 1.1e-3}, {16, 9e-5}}},
      {Realization::crossbar, 41, 1e-5, {{8, .35}, {10, .12}, {12, 3e-2}}}};
  for (const Row& row : table) {
    const NetworkProblem problem = array_network(row.count, row.alpha).problem;
    for (const auto& [bits, error] : row.errors) {
      CAPTURE(name(row.realization), row.count, row.alpha, bits);
      const ToleranceResult result = study(row.realization, problem, {.bits = bits});
      CHECK(result.trials == 1);
      CHECK(result.worst.empty());
      CHECK_THAT(result.median, WithinRel(error, 0.2));
    }
  }
}

TEST_CASE("noise of cells errs as was measured", "[programmed]") {
  struct Row {
    std::size_t count;
    double alpha, error;
  };
  for (const auto& [count, alpha, error] : {Row{21, 1e-3, 1.2e-2}, Row{21, 1e-5, 7.9e-2},
                                            Row{41, 1e-3, 5.6e-3}, Row{41, 1e-5, 3.5e-2}}) {
    CAPTURE(count, alpha);
    const NetworkProblem problem = array_network(count, alpha).problem;
    const ToleranceResult result =
        study(Realization::least_squares, problem, {.cell_noise = 0.005, .trials = 60});
    CHECK_THAT(result.median, WithinRel(error, 0.2));
  }
}

TEST_CASE("wires err as the whole network of their crossings does", "[programmed][wires]") {
  struct Row {
    std::size_t count;
    double siemens;
  };
  for (const auto& [count, siemens] : {Row{21, 1e-3}, Row{21, 1e-4}, Row{41, 1e-4}})
    for (const Form& one : forms) {
      CAPTURE(count, siemens, name(one.realization), one.ladder);
      const NetworkProblem problem = array_network(count, 1e-3).problem;
      const Circuit circuit = circuit_of(one, problem, siemens);
      const ToleranceResult seen = tolerate(Reduction(circuit), {.wire_resistance = 0.5});
      CHECK(seen.trials == 1);
      CHECK_THAT(seen.median, WithinRel(wired_error(circuit, 0.5), 0.01));
      CHECK_THAT(seen.predicted, WithinRel(seen.median, 0.1));
    }
}

TEST_CASE("arrays at nodes that nothing drives are exactly what their wires make of them",
          "[programmed][wires]") {
  NetworkProblem problem = array_network(7, 1e-3).problem;
  for (std::size_t j = 0; j < 7; ++j) problem.kernel(3, j) = 0.0;  // a dead taxel
  for (std::size_t i = 0; i < 7; ++i)  // a column of one sign, and a line without a cell
    problem.kernel(i, 5) = std::abs(problem.kernel(i, 5));
  for (const Form& one : {Form{Realization::least_squares, true}, Form{Realization::lattice}}) {
    CAPTURE(name(one.realization), one.ladder);
    const Circuit circuit = circuit_of(one, problem);
    const Reduction reduction(circuit);
    const ToleranceOptions options{.wire_resistance = 20.0};
    const std::vector<Resistor> paths = paths_of_lines(reduction, options);
    CHECK_FALSE(paths.empty());
    const std::vector<double> siemens = drawn(reduction, options, 0);
    const Trial seen = try_out(reduction, siemens, paths);
    CHECK(seen.stable);
    CHECK(seen.error > 0.02);
    Circuit exact = circuit;
    for (AmplifierModel& model : exact.amplifiers) model.opamp = {.gain = 1e11};
    const std::vector<double> wired = operating_voltages(FlatCircuit(with_wires(exact, 20.0)));
    // Of a ladder K transposed leads from outputs into summing nodes, where a line and its inverse
    // are one; that is exact too.
    CHECK(relative_l2_error(seen.voltages, wired) < 1e-6);
    const Circuit replayed = perturbed(FlatCircuit(exact), siemens, paths);
    CHECK(relative_l2_error(operating_voltages(FlatCircuit(replayed)), seen.voltages) < 1e-6);
  }
  CHECK(
      paths_of_lines(Reduction(realize(Realization::crossbar, problem)), {.wire_resistance = 20.0})
          .empty());
}

TEST_CASE("what two ends have between them is symmetric, and all of it is the array",
          "[programmed][wires][property]") {
  std::vector<ArrayCell> cells;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 5; ++c)
      if ((i + c) % 3 != 0) cells.push_back({i, c, 1e-3 * static_cast<double>(1 + 2 * i + c)});
  const Matrix between = between_ends(cells, 4, 5, 3.0);
  const Matrix driven = seen_from_ends(cells, 4, 5, 3.0);
  for (std::size_t a = 0; a < 9; ++a) {
    CHECK(between(a, a) == 0.0);
    for (std::size_t b = 0; b < 9; ++b) {
      CHECK(between(a, b) >= 0.0);
      CHECK_THAT(between(a, b), WithinRel(between(b, a), 1e-10));
      if (a < 4 && b >= 4) CHECK(between(a, b) == driven(a, b - 4));
    }
  }
  // Wires of nothing leave each cell, and nothing else.
  const Matrix bare = between_ends(cells, 4, 5, 1e-9);
  double rest = 0.0;
  for (const double one : bare.values) rest += one;
  for (const ArrayCell& cell : cells) {
    CHECK_THAT(bare(cell.row, 4 + cell.line), WithinRel(cell.siemens, 1e-6));
    rest -= 2.0 * bare(cell.row, 4 + cell.line);
  }
  CHECK(std::abs(rest) < 1e-8);
}

TEST_CASE("wires of arrays that are not symmetric lie as they do", "[programmed][wires]") {
  NetworkProblem problem = array_network(9, 1e-3, 2).problem;
  for (std::size_t i = 0; i < problem.kernel.rows; ++i)
    for (std::size_t j = 0; j < problem.kernel.columns; ++j)
      problem.kernel(i, j) *= i == 4 ? 0.0 : 1.0 + 0.3 * static_cast<double>(i);
  for (const Form& one : forms) {
    if (one.realization == Realization::crossbar) continue;  // has no K
    CAPTURE(name(one.realization), one.ladder);
    const Circuit circuit = circuit_of(one, problem);
    CHECK_THAT(tolerate(Reduction(circuit), {.wire_resistance = 2.0}).median,
               WithinRel(wired_error(circuit, 2.0), 0.01));
  }
}

TEST_CASE("ends of an array's lines see 1.5 N r G less, of lattice's 1.75 N r G",
          "[programmed][wires]") {
  struct Row {
    Realization realization;
    Array array;
    double factor;
  };
  constexpr double ohm = 5.0;
  for (const auto& [one, array, factor] : {Row{Realization::least_squares, Array::kernel, 1.5},
                                           Row{Realization::lattice, Array::kernel, 1.75},
                                           Row{Realization::lattice, Array::transposed, 1.75}})
    for (const std::size_t count : {21U, 41U})
      for (const double siemens : {1e-5, 1e-4, 1e-3}) {
        const Circuit circuit = circuit_of({one}, array_network(count, 1e-3).problem, siemens);
        const std::size_t rows = one == Realization::lattice ? 2 * count : count;
        const bool turned = array == Array::transposed;
        std::vector<ArrayCell> cells;
        std::vector<double> totals(rows);
        for (const Resistor& r : circuit.resistors) {
          const ResistorPlace place = place_of(r.name);
          if (place.array != array) continue;
          const char row = circuit.nodes[turned ? r.from : r.to][0];
          const char line = circuit.nodes[turned ? r.to : r.from][0];
          const std::size_t at = rows == count ? place.row : 2 * place.row + (row == 'v' ? 1U : 0U);
          cells.push_back(
              {at, 2 * place.column + (line == 'r' || line == 's' ? 1U : 0U), r.siemens});
          totals[at] += r.siemens;
        }
        const Matrix seen = seen_from_ends(cells, rows, 2 * count, ohm);
        double change = 0.0;
        double size = 0.0;
        for (const ArrayCell& cell : cells) {
          change += std::pow(seen(cell.row, cell.line) - cell.siemens, 2);
          size += std::pow(cell.siemens, 2);
        }
        const double error = std::sqrt(change / size);
        const double largest = *std::max_element(totals.begin(), totals.end());
        const double formula = factor * static_cast<double>(count) * ohm * largest;
        CAPTURE(name(one), count, siemens, error);
        if (formula < 5e-2) CHECK_THAT(error, WithinRel(formula, 0.2));
      }
}

TEST_CASE("what steps and wires do vanishes with them", "[programmed][property]") {
  const NetworkProblem problem = array_network(11, 1e-4).problem;
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    double before = 1.0;
    for (const int bits : {12, 16, 20, 24, 28}) {
      const ToleranceResult result = study(one, problem, {.bits = bits});
      CHECK(result.median < 0.4 * before);
      CHECK(result.stable == 1);
      CHECK_THAT(result.predicted, WithinRel(result.median, 0.1));
      before = result.median;
    }
    CHECK(before < 1e-5);
    const double thin = study(one, problem, {.wire_resistance = 1e-3}).median;
    CHECK_THAT(study(one, problem, {.wire_resistance = 1e-4}).median, WithinRel(0.1 * thin, 0.01));
  }
}

TEST_CASE("first order predicts small noise of cells", "[programmed][property]") {
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  for (const Realization one :
       {Realization::crossbar, Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    // So small that next to no cell would fall below 0.
    const ToleranceResult result = study(one, problem, {.cell_noise = 1e-7, .trials = 300});
    double squares = 0.0;
    for (const double error : result.errors) squares += error * error;
    CHECK_THAT(std::sqrt(squares / 300.0), WithinRel(result.predicted, 0.1));
    CHECK(result.worst.size() == 5);
  }
}

TEST_CASE("cells are programmed, the other parts drawn", "[programmed]") {
  const NetworkProblem problem = array_network(7, 1e-3).problem;
  const Reduction reduction(realize(Realization::least_squares, problem));
  const ToleranceOptions options{.relative = 0.01, .bits = 6, .trials = 2};
  const std::vector<double> first = drawn(reduction, options, 0);
  const std::vector<double> second = drawn(reduction, options, 1);
  double largest = 0.0;
  for (std::size_t r = 0; r < first.size(); ++r)
    if (place_of(reduction.resistors()[r]).array == Array::kernel)
      largest = std::max(largest, reduction.siemens()[r]);
  std::size_t cells = 0;
  for (std::size_t r = 0; r < first.size(); ++r) {
    const Array array = place_of(reduction.resistors()[r]).array;
    const bool cell = array == Array::kernel || array == Array::transposed;
    CHECK((first[r] == second[r]) == cell);
    if (!cell) continue;
    ++cells;
    const double steps = first[r] / largest * 63.0;
    CHECK_THAT(steps, WithinAbs(std::round(steps), 1e-9));
    CHECK(std::abs(first[r] - reduction.siemens()[r]) <= 0.5001 * largest / 63.0);
  }
  CHECK(cells == 2 * 7 * 7);
  // The same without steps: draws of parts are those of every other study.
  const std::vector<double> soldered = drawn(reduction, {.relative = 0.01}, 0);
  for (std::size_t r = 0; r < first.size(); ++r)
    if (place_of(reduction.resistors()[r]).array == Array::stabiliser)
      CHECK(first[r] == soldered[r]);
}

TEST_CASE("a cell that is programmed to nothing is left out of the circuit", "[programmed]") {
  const NetworkProblem problem = array_network(7, 1e-3).problem;
  const Circuit circuit = realize(Realization::least_squares, problem);
  const Reduction reduction(circuit);
  const std::vector<double> siemens = drawn(reduction, {.bits = 2}, 0);
  Circuit built = perturbed(FlatCircuit(circuit), siemens);
  CHECK(built.resistors.size() < circuit.resistors.size());
  for (AmplifierModel& model : built.amplifiers) model.opamp = {.gain = 1e12};
  CHECK(relative_l2_error(operating_voltages(FlatCircuit(built)),
                          try_out(reduction, siemens).voltages) < 1e-8);
}

TEST_CASE("arrays with dead taxels, blind columns and two taxels are programmed too",
          "[programmed][hard]") {
  std::vector<NetworkProblem> edges = {array_network(2, 1e-3).problem,
                                       array_network(9, 1e-3).problem,
                                       array_network(9, 1e-3).problem};
  for (std::size_t j = 0; j < 9; ++j) edges[1].kernel(4, j) = 0.0;
  for (std::size_t i = 0; i < 9; ++i) edges[2].kernel(i, 4) = 0.0;
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (const Realization one : {Realization::least_squares, Realization::lattice}) {
      CAPTURE(k, name(one));
      const ToleranceOptions options{
          .bits = 1, .cell_noise = 0.1, .wire_resistance = 10.0, .trials = 20};
      const ToleranceResult result = study(one, edges[k], options);
      CHECK(result.errors.size() == 20);
      CHECK(std::isfinite(result.predicted));
      CHECK(study(one, edges[k], {.bits = 30}).median < 1e-6);
    }
}

TEST_CASE("what is no array cannot be programmed, nor what is out of range", "[programmed]") {
  const NetworkProblem problem = array_network(5, 1e-3).problem;
  for (const Realization one : {Realization::ideal, Realization::nic, Realization::rail}) {
    CAPTURE(name(one));
    CHECK_THROWS_AS(study(one, problem, {.bits = 8}), std::invalid_argument);
    CHECK_THROWS_AS(study(one, problem, {.wire_resistance = 1.0}), std::invalid_argument);
  }
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    const Reduction inverters(realize(one, array_network(11, 1e-3).problem, {.inverters = true}));
    CHECK_THROWS_AS(tolerate(inverters, {.wire_resistance = 1.0}), std::invalid_argument);
    CHECK(tolerate(inverters, {.bits = 16}).stable == 1);
  }
  const auto refused = [&](const ToleranceOptions& options) {
    CHECK_THROWS_AS(study(Realization::crossbar, problem, options), std::invalid_argument);
  };
  refused({.bits = 0});
  refused({.bits = 33});
  refused({.cell_noise = 0.0});
  refused({.cell_noise = 1.0});
  refused({.wire_resistance = 0.0});
  refused({.wire_resistance = INFINITY});
  refused({.series = Series::e96, .bits = 8});
  refused({});
}

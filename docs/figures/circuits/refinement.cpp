// Circuits of parts that are off, refined in numbers.
#include "tactile_net/network/refinement.hpp"

#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include "docs/figures/circuits/numbers.hpp"
#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::circuits {
namespace {

struct Case {
  Realization realization = Realization::lattice;
  std::size_t taxels = 41;
  double alpha = 1e-3;
  ToleranceOptions tolerances{.relative = 0.01, .trials = 200};
  const char* parts = "1 %";
};

std::string size_text(double error) { return std::isfinite(error) ? brief(error, 2) : "unstable"; }

std::string row_of(const Case& one) {
  constexpr std::size_t cycles = 6;
  const NetworkProblem problem = array_problem(one.taxels, one.alpha);
  double largest = 0.0;
  for (const double f : solve_symmetric(problem.matrix, problem.right_side))
    largest = std::max(largest, std::abs(f));
  const NetworkCircuit circuit(one.realization, std::make_shared<const NetworkProblem>(problem),
                               {.scale = {.volts = 1.0 / largest}, .opamp = {.gain = 1e6}});
  std::cerr << "refinement, " << name(one.realization) << ' ' << one.taxels << '\n';
  const Refinement refinement(circuit, one.tolerances, {.cycles = cycles});
  const RefinementBound bound = refinement.bound();
  const RefinementTrials trials = refinement.trials();
  std::string row = "| " + std::string(name(one.realization)) + ", " + std::to_string(one.taxels) +
                    ", " + shortest(one.alpha) + " | " + one.parts + " | " + brief(bound.parts) +
                    "; " + brief(bound.parts_of_most) + " | " + brief(trials.median_deviation) +
                    ", " + brief(trials.worst_deviation) + "; " + brief(trials.adverse_deviation) +
                    " | " + std::string(name(verdict(bound, trials, true))) + " |";
  for (const RefinementTrials::Cycle& cycle : trials.cycles)
    row += " " + size_text(cycle.p95) + " |";
  return row + " " + (trials.p95_cycles ? std::to_string(*trials.p95_cycles) : "-") + " |\n";
}

}  // namespace

std::string refinement_table() {
  using enum Realization;
  const ToleranceOptions finer{.relative = 0.005, .trials = 200};
  const ToleranceOptions stabiliser{.relative = 0.01, .stabiliser = 0.001, .trials = 200};
  const ToleranceOptions cells{.bits = 6, .trials = 1};
  std::string table =
      "| circuit, taxels, alpha | parts | bound | builds | verdict | 1 | 2 | 3 | 4 | 5 | 6 | to "
      "1e-6 |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Case& one :
       {Case{lattice}, Case{lattice, 41, 1e-3, stabiliser, "1 %, stabiliser .1 %"},
        Case{lattice, 41, 1e-3, cells, "cells of 6 bits"}, Case{least_squares}, Case{crossbar},
        Case{lattice, 41, 1e-5}, Case{lattice, 41, 1e-5, finer, "0.5 %"},
        Case{least_squares, 41, 1e-5}, Case{lattice, 21, 1e-5}, Case{crossbar, 21, 1e-5}})
    table += row_of(one);
  return table;
}

}  // namespace tactile_net::circuits

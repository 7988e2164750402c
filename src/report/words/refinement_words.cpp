#include "tactile_net/report/words/refinement_words.hpp"

#include <cmath>

#include "numeric/named.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

using Way = lab::CircuitRefinement::Way;

std::string error_size_in_words(double error) {
  return std::isfinite(error) ? brief(error, 2) : "unstable";
}

std::string way_in_words(const Way& way) {
  const std::string parts = way.tolerance > 0.0 ? " within " + percent(way.tolerance) : "";
  switch (way.kind) {
    case Way::Kind::alone:
      return "the circuit, its parts" + (parts.empty() ? " as they are" : parts);
    case Way::Kind::better_parts:
      return "the circuit, all parts" + parts + " (to first order)";
    case Way::Kind::refined:
      return "refined, " + std::to_string(way.cycles) + (way.cycles == 1 ? " cycle" : " cycles");
    case Way::Kind::numbers:
      return "no circuit: f = M g in numbers";
  }
  return {};
}

std::string what_to_do(const lab::CircuitRefinement& one) {
  if (one.trials.stable < one.trials.builds)
    return std::to_string(one.trials.builds - one.trials.stable) + " of " +
           std::to_string(one.trials.builds) + " builds are unstable; " +
           std::string(lab::steadier_builds);
  if (one.bound.contraction_of_most() >= 1.0)
    return "nothing is proven of builds: their deviation |X| may reach " + brief(one.bound.parts) +
           ", of all but one in a million " + brief(one.bound.parts_of_most) +
           ", beside converters of " + brief(one.bound.to_circuit + one.bound.from_circuit) +
           ", and all of it together must stay below 1; take better parts or converters, or a "
           "larger alpha";
  return "the circuit is not known to be stable with its op-amps";
}

std::string converters_in_words(const RefinementOptions& options) {
  const Converters& converters = *options.converters;
  return "converters of " + std::to_string(converters.bits) + " bits, gains within " +
         percent(converters.gain) + ", noise of " + percent(converters.noise) +
         " of the range, steps: " +
         std::string(name_in<Enumerators<RefinementStep>::all>(options.step));
}

std::string cycles_in_words(const std::optional<std::size_t>& cycles, std::size_t most) {
  return cycles ? "after " + std::to_string(*cycles) + (*cycles == 1 ? " cycle" : " cycles")
                : "not within " + std::to_string(most) + " cycles";
}

}  // namespace

std::string verdict_in_words(const lab::CircuitRefinement& one) {
  if (one.verdict == RefinementVerdict::refused)
    return "refinement REFUSED: " + what_to_do(one) + ".";
  const bool all = one.verdict == RefinementVerdict::proven;
  const double rate = all ? one.bound.contraction() : one.bound.contraction_of_most();
  return std::string("refinement proven") + (all ? "" : " for all but one build in a million") +
         " (theorem T9): a cycle leaves at most " + percent(rate) + " of the error's energy, so " +
         brief(one.options.accuracy) + " is reached after " +
         std::to_string(one.proven_cycles.value_or(0)) + " cycles.";
}

std::vector<std::string> in_words(const lab::CircuitRefinement& one) {
  const RefinementBound& bound = one.bound;
  const RefinementTrials& trials = one.trials;
  std::vector<std::string> lines = {verdict_in_words(one)};
  lines.push_back("deviation |X| of builds of " + kinds_of_errors(one.drawn) + ": at most " +
                  brief(bound.parts) + " (K " + brief(bound.kernel) + ", " +
                  (bound.z > 0.0 ? "stabiliser " : "P ") + brief(bound.stabiliser) +
                  (bound.common > 0.0 ? ", inputs' common voltages " + brief(bound.common) : "") +
                  (bound.fixed > 1e-6 ? ", in every build " + brief(bound.fixed) : "") +
                  "), of all but one in a million " + brief(bound.parts_of_most) + "; of " +
                  std::to_string(trials.builds) + " builds median " +
                  brief(trials.median_deviation) + ", worst " + brief(trials.worst_deviation) +
                  ", errors that conspire " + brief(trials.adverse_deviation));
  lines.push_back(converters_in_words(one.options) + ": they turn a cycle by " +
                  brief(bound.to_circuit) + " and " + brief(bound.from_circuit) + " at most");
  lines.push_back(brief(one.options.accuracy) + ": the median build " +
                  cycles_in_words(trials.median_cycles, trials.cycles.size()) + ", 95 of 100 " +
                  cycles_in_words(trials.p95_cycles, trials.cycles.size()) +
                  "; arithmetic ends at " + brief(trials.single_floor, 2) +
                  " in single precision, at " + brief(trials.double_floor, 2) + " in double");
  if (trials.cycles.size() > 1 && std::isfinite(trials.self_test.limit))
    lines.push_back(
        "self-test without a bench: the first step over the answer is the board's own "
        "error within " +
        percent(trials.self_test.apart) + " of itself; reject a board above " +
        percent(trials.self_test.limit) + ", which 95 of 100 builds stay below");
  lines.push_back("it is no way to beat the digital frame: a cycle takes " +
                  std::to_string(trials.cycle_products) +
                  " multiplications, the whole answer in "
                  "numbers " +
                  std::to_string(trials.frame_products) +
                  "; it pays as a self-test, and for boards of coarse cells that are programmed");
  return lines;
}

std::vector<std::vector<std::string>> cycle_cells(const lab::CircuitRefinement& one) {
  std::vector<std::vector<std::string>> rows = {{"cycle", "median error", "95 of 100",
                                                 "worst of " + std::to_string(one.trials.builds),
                                                 "errors that conspire"}};
  for (std::size_t k = 0; k < one.trials.cycles.size(); ++k) {
    const RefinementTrials::Cycle& cycle = one.trials.cycles[k];
    rows.push_back({std::to_string(k + 1), error_size_in_words(cycle.median),
                    error_size_in_words(cycle.p95), error_size_in_words(cycle.worst),
                    error_size_in_words(cycle.adverse)});
  }
  return rows;
}

std::vector<std::vector<std::string>> way_cells(const lab::CircuitRefinement& one) {
  std::vector<std::vector<std::string>> rows = {
      {"way", "error of 95 of 100", "price", "time without arithmetic", "multiplications"}};
  for (const Way& way : one.ways)
    rows.push_back({way_in_words(way), error_size_in_words(way.error),
                    way.price ? brief(*way.price) : "-", way.seconds ? duration(*way.seconds) : "-",
                    std::to_string(way.products)});
  return rows;
}

std::vector<std::string> in_words(const lab::SimulatedRefinement& one) {
  const std::string build = "the first build of " + kinds_of_errors(one.drawn);
  if (one.cycles.empty())
    return {"NOT REFINED: " + build + " is not stable; " + std::string(lab::steadier_builds)};
  return {(one.agrees() ? "as in numbers: " : "OTHERWISE THAN IN NUMBERS: ") + build +
              " comes to " + brief(one.cycles.back().simulated, 2) + " of the exact answer after " +
              std::to_string(one.cycles.size()) + (one.cycles.size() == 1 ? " cycle" : " cycles") +
              " in ngspice, to " + brief(one.cycles.back().numbers, 2) + " in numbers",
          converters_in_words(one.options), "ngspice took " + duration(one.simulator_seconds)};
}

std::vector<std::vector<std::string>> cycle_cells(const lab::SimulatedRefinement& one) {
  std::vector<std::vector<std::string>> rows = {
      {"cycle", "error in ngspice", "error in numbers", "the circuit's answer, off its equations"}};
  for (std::size_t k = 0; k < one.cycles.size(); ++k)
    rows.push_back({std::to_string(k + 1), brief(one.cycles[k].simulated, 3),
                    brief(one.cycles[k].numbers, 3), brief(one.cycles[k].difference, 2)});
  return rows;
}

}  // namespace tactile_net::report

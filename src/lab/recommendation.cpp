#include "tactile_net/lab/recommendation.hpp"

#include <algorithm>
#include <cmath>

#include "lab/circuit_candidates.hpp"

namespace tactile_net::lab {
namespace {

constexpr double wanted_yield = 0.95;  // of the builds

/// Enough draws to tell 95 of 100; fewer where a trial of a large network takes its time.
std::size_t enough_draws(std::size_t nodes) { return nodes <= 60 ? 200 : nodes <= 130 ? 60 : 20; }

/// Whether what is drawn is of parts alone, so that better parts are all it takes.
bool of_parts_alone(const ToleranceOptions& drawn) {
  return !drawn.bits && !drawn.cell_noise && !drawn.wire_resistance;
}

Recommendation::Candidate tried(const NetworkCircuit& circuit, const ToleranceOptions& options) {
  return {.realization = circuit.realization(),
          .ladder = form_of(circuit).ladder,
          .opamps = circuit.flat().amplifiers().size(),
          .stable = is_stable_with_its_opamps(circuit),
          .tolerance = tolerate(circuit.reduction(), options)};
}

void choose(Recommendation& result) {
  const auto& all = result.candidates;
  const auto good = std::find_if(all.begin(), all.end(), [](const auto& candidate) {
    return candidate.stable && candidate.tolerance.yield() >= wanted_yield;
  });
  if (good != all.end()) {
    result.outcome = Recommendation::Outcome::reached;
    result.choice = static_cast<std::size_t>(good - all.begin());
    return;
  }
  const auto nearest = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.stable != b.stable ? a.stable : a.tolerance.p95 < b.tolerance.p95;
  });
  result.outcome = Recommendation::Outcome::none_reaches;
  result.choice = static_cast<std::size_t>(nearest - all.begin());
  if (result.drawn.relative && of_parts_alone(result.drawn) &&
      std::isfinite(nearest->tolerance.p95))
    result.parts_needed = *result.drawn.relative * result.drawn.accuracy / nearest->tolerance.p95;
}

}  // namespace

Recommendation recommend(const SceneCircuit& circuit) {
  Recommendation result{.drawn = circuit.tolerance(),
                        .inverters_replaced = circuit.options().parts.inverters};
  if (!circuit.loaded()) return result;
  result.drawn.trials = std::min(result.drawn.trials, enough_draws(circuit.nodes()));
  const NetworkCircuit& own = circuit.network();
  for (const CircuitForm& one : candidates(circuit)) {
    if (!of_parts_alone(result.drawn) && !traits(one.realization).drives_nodes) continue;
    const bool built = one.realization == own.realization() && one.ladder == form_of(own).ladder &&
                       !result.inverters_replaced;
    result.candidates.push_back(built ? tried(own, result.drawn)
                                      : tried(candidate(one, circuit), result.drawn));
  }
  std::stable_sort(
      result.candidates.begin(), result.candidates.end(), [](const auto& a, const auto& b) {
        return a.opamps != b.opamps ? a.opamps < b.opamps : a.tolerance.p95 < b.tolerance.p95;
      });
  choose(result);
  return result;
}

}  // namespace tactile_net::lab

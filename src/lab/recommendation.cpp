#include "tactile_net/lab/recommendation.hpp"

#include <algorithm>
#include <cmath>

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
          .ladder = has_ladder(circuit.realization(), circuit.options()),
          .opamps = circuit.flat().amplifiers().size(),
          .stability = stability_of(circuit),
          .tolerance = tolerate(circuit, options)};
}

void choose(Recommendation& result) {
  const auto& all = result.candidates;
  const auto good = std::find_if(all.begin(), all.end(), [](const auto& candidate) {
    return candidate.stable() && candidate.tolerance.yield() >= wanted_yield;
  });
  if (good != all.end()) {
    result.outcome = Recommendation::Outcome::reached;
    result.choice = static_cast<std::size_t>(good - all.begin());
    return;
  }
  const auto nearest = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.stable() != b.stable() ? a.stable() : a.tolerance.p95 < b.tolerance.p95;
  });
  if (nearest == all.end() || !nearest->stable()) {
    result.outcome = Recommendation::Outcome::none_stable;
    return;
  }
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
  for (const auto& one : circuit.candidates())
    if (of_parts_alone(result.drawn) || traits(one->realization()).drives_nodes)
      result.candidates.push_back(tried(*one, result.drawn));
  std::stable_sort(
      result.candidates.begin(), result.candidates.end(), [](const auto& a, const auto& b) {
        return a.opamps != b.opamps ? a.opamps < b.opamps : a.tolerance.p95 < b.tolerance.p95;
      });
  choose(result);
  return result;
}

}  // namespace tactile_net::lab

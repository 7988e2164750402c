#include "tactile_net/lab/recommendation.hpp"

#include <algorithm>
#include <cmath>

namespace tactile_net::lab {
namespace {

constexpr double enough = 0.95;  // of the builds

/// Enough draws to tell 95 of 100; fewer where a trial of a large network takes its time.
std::size_t draws(std::size_t nodes) { return nodes <= 60 ? 200 : nodes <= 130 ? 60 : 20; }

Recommendation::Candidate tried(const NetworkCircuit& circuit, const ToleranceOptions& options) {
  return {.realization = circuit.realization(),
          .opamps = circuit.flat().amplifiers().size(),
          .tolerance = tolerate(circuit.reduction(), options)};
}

void choose(Recommendation& result) {
  const auto& all = result.candidates;
  const auto good = std::find_if(all.begin(), all.end(), [](const auto& candidate) {
    return candidate.tolerance.yield() >= enough;
  });
  if (good != all.end()) {
    result.outcome = Recommendation::Outcome::reached;
    result.choice = static_cast<std::size_t>(good - all.begin());
    return;
  }
  const auto nearest = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.tolerance.p95 < b.tolerance.p95;
  });
  result.outcome = Recommendation::Outcome::none_reaches;
  result.choice = static_cast<std::size_t>(nearest - all.begin());
  if (result.drawn.relative && std::isfinite(nearest->tolerance.p95))
    result.parts_needed = *result.drawn.relative * result.drawn.accuracy / nearest->tolerance.p95;
}

}  // namespace

Recommendation recommend(const SceneCircuit& circuit) {
  Recommendation result{.drawn = circuit.tolerance(),
                        .inverters_replaced = circuit.options().parts.inverters};
  if (!circuit.loaded()) return result;
  result.drawn.trials = std::min(result.drawn.trials, draws(circuit.nodes()));
  RealizationOptions parts = circuit.options().parts;
  parts.inverters = false;
  const NetworkCircuit& own = circuit.network();
  for (const Realization one : realizations) {
    if (!traits(one).uses_opamps || !traits(one).linear() || !circuit.fits(one)) continue;
    if (traits(one).opamps_per_branch && circuit.nodes() > 130) continue;  // tens of thousands
    const bool built = one == own.realization() && !result.inverters_replaced;
    result.candidates.push_back(
        built ? tried(own, result.drawn)
              : tried(NetworkCircuit(one, own.shared_problem(), parts), result.drawn));
  }
  std::stable_sort(result.candidates.begin(), result.candidates.end(),
                   [](const auto& a, const auto& b) { return a.opamps < b.opamps; });
  choose(result);
  return result;
}

}  // namespace tactile_net::lab

#include "tactile_net/skin/tangential_weight.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/skin/family.hpp"

namespace tactile_net {

double likeliest_tangential_weight(
    const std::function<double(double weight)>& negative_log_posterior) {
  std::vector<double> weights(tangential_weights.begin(), tangential_weights.end());
  std::sort(weights.begin(), weights.end());
  const auto last = std::ssize(weights) - 1;
  const auto one = std::find(weights.begin(), weights.end(), 1.0) - weights.begin();
  std::map<std::ptrdiff_t, double> known;
  const auto value = [&](std::ptrdiff_t at) {
    const auto [entry, is_new] = known.try_emplace(at);
    if (is_new) entry->second = negative_log_posterior(weights[static_cast<std::size_t>(at)]);
    return entry->second;
  };

  std::ptrdiff_t best = one;
  for (const std::ptrdiff_t step : {2, 1})
    for (const std::ptrdiff_t way : {step, -step})
      while (best + way >= 0 && best + way <= last && value(best + way) < value(best)) best += way;
  return weights[static_cast<std::size_t>(best)];
}

double likeliest_tangential_weight(SkinProblem problem, std::span<const double> readings,
                                   std::optional<double> noise_rms) {
  if (problem.components == 1) return 1.0;
  return likeliest_tangential_weight([&](double weight) {
    problem.tangential_weight = weight;
    const SkinFamily family(problem);
    const FilterFrame frame = family.analyse(readings);
    return negative_log_evidence(frame, AlphaTables(family.singular_values(), frame.rows),
                                 noise_rms) +
           negative_log_prior(weight);
  });
}

}  // namespace tactile_net

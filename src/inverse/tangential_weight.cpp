#include "tactile_net/inverse/tangential_weight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <vector>

#include "inverse/alpha_criteria.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"

namespace tactile_net {

double negative_log_prior(double tangential_weight) noexcept {
  return std::log(0.5 * (tangential_weight + 1.0 / tangential_weight));
}

double negative_log_evidence(const FilterFrame& frame, const AlphaTables& tables,
                             std::optional<double> noise_rms, std::optional<double> alpha) {
  if (noise_rms && !(*noise_rms > 0.0)) throw std::invalid_argument("noise_rms must be > 0");
  const AlphaTables::Parts& parts = tables.parts();
  check_family(frame, parts);
  const AlphaRule rule = noise_rms ? AlphaRule::evidence : AlphaRule::gml;
  const double chosen = alpha ? *alpha : choose_alone(frame, tables, rule, noise_rms).alpha;
  if (!(frame.scale > 0.0) || !(parts.largest > 0.0)) return 0.0;

  const double log_alpha = std::log(chosen) - 2.0 * std::log(parts.largest);
  const double relative_alpha = std::exp(log_alpha);
  double fit = frame.outside * frame.outside;  // g'(I - H) g
  for (std::size_t i = 0; i < parts.relative.size(); ++i) {
    const double power = frame.powers.empty() ? frame.beta[i] * frame.beta[i] : frame.powers[i];
    fit += relative_alpha / (parts.relative[i] * parts.relative[i] + relative_alpha) * power;
  }
  const double log_determinant = parts.traces(log_alpha).log_determinant;
  const double size = noise_rms ? fit * (frame.scale / *noise_rms) * (frame.scale / *noise_rms)
                                : static_cast<double>(parts.rows) * std::log(fit);
  return 0.5 * (size - log_determinant);
}

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

double likeliest_tangential_weight(LinearProblem problem, std::span<const double> readings,
                                   std::optional<double> noise_rms) {
  if (problem.components == 1) return 1.0;
  return likeliest_tangential_weight([&](double weight) {
    problem.tangential_weight = weight;
    const TikhonovFamily family(problem);
    const FilterFrame frame = family.analyse(readings);
    return negative_log_evidence(frame, AlphaTables(family.singular_values(), frame.rows),
                                 noise_rms) +
           negative_log_prior(weight);
  });
}

}  // namespace tactile_net

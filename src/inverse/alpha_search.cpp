#include "inverse/alpha_search.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tactile_net {
namespace {

/// The root of `function` between two steps, to the last digit.
double root(const std::function<double(double)>& function, double from, double to, double at_from,
            double at_to) {
  if (at_from == 0.0) return from;
  if (at_to == 0.0) return to;
  std::uintmax_t calls = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      function, from, to, at_from, at_to, boost::math::tools::eps_tolerance<double>(50), calls);
  return 0.5 * (low + high);
}

FoundAlpha least(const AlphaTables::Parts& tables, std::span<const double> values,
                 const std::function<double(double)>& slope) {
  const auto better = [&](std::size_t one, std::size_t other) {
    return std::isfinite(values[one]) &&
           (!std::isfinite(values[other]) || values[one] < values[other]);
  };
  std::size_t best = tables.first;
  for (std::size_t i = tables.first; i <= tables.last; ++i)
    if (better(i, best)) best = i;
  while (best > 0 && better(best - 1, best)) --best;
  while (best + 1 < alpha_steps && better(best + 1, best)) ++best;
  if (!std::isfinite(values[best])) return nothing_to_choose(tables);
  if (best == 0 || best + 1 == alpha_steps) return {tables.at(best), AlphaVerdict::border};
  const double from = tables.at(best - 1);
  const double to = tables.at(best + 1);
  const double at_from = slope(from);
  const double at_to = slope(to);
  if (!(at_from < 0.0 && at_to > 0.0))  // several dips side by side, or a plateau
    return {tables.at(best),
            tables.first < best && best < tables.last ? AlphaVerdict::ok : AlphaVerdict::border};
  return {root(slope, from, to, at_from, at_to), AlphaVerdict::ok};
}

/// rho rises with alpha.
FoundAlpha crossing(const AlphaTables::Parts& tables, std::span<const double> values,
                    const std::function<double(double)>& misfit) {
  if (!(values.front() <= 0.0)) return {tables.at(0), AlphaVerdict::no_root};
  if (!(values.back() >= 0.0)) return nothing_to_choose(tables);
  const auto above = std::upper_bound(values.begin(), values.end(), 0.0);
  const auto next = static_cast<std::size_t>(
      std::min(above - values.begin(), static_cast<std::ptrdiff_t>(alpha_steps - 1)));
  const double from = tables.at(next - 1);
  const double to = tables.at(next);
  return {root(misfit, from, to, misfit(from), misfit(to)), AlphaVerdict::ok};
}

}  // namespace

FoundAlpha nothing_to_choose(const AlphaTables::Parts& tables) {
  return {tables.at(alpha_steps - 1), AlphaVerdict::no_root};
}

FoundAlpha search(const AlphaTables::Parts& tables, AlphaRule rule, std::span<const double> values,
                  const std::function<double(double)>& zero) {
  return rule == AlphaRule::discrepancy ? crossing(tables, values, zero)
                                        : least(tables, values, zero);
}

AlphaVerdict judge(const Criteria& criteria, const AlphaTables::Parts& tables, AlphaRule rule,
                   const FoundAlpha& one, std::vector<double> others) {
  if (criteria.silent()) return AlphaVerdict::no_root;
  if (!trusted(tables, rule)) return AlphaVerdict::noise_needed;
  if (one.verdict != AlphaVerdict::ok) return one.verdict;
  if (criteria.difference(one.log_alpha, one.log_alpha + std::log(10.0)) > 1.0)
    return AlphaVerdict::unstable;
  if (others.empty()) return one.verdict;
  const auto middle = others.begin() + std::ssize(others) / 2;
  std::nth_element(others.begin(), middle, others.end());
  return criteria.difference(one.log_alpha, *middle) > 0.5 ? AlphaVerdict::rules_disagree
                                                           : AlphaVerdict::ok;
}

bool lacks_noise(AlphaRule rule, std::optional<double> noise_rms) noexcept {
  return needs_noise(rule) && !noise_rms;
}
bool lacks_periodogram(AlphaRule rule, const FilterFrame& frame) noexcept {
  return needs_periodogram(rule) && !frame.periodogram;
}

void require_noise(AlphaRule rule, std::optional<double> noise_rms) {
  if (lacks_noise(rule, noise_rms))
    throw std::invalid_argument("the rule " + std::string(name(rule)) +
                                " needs the rms of the noise: state it, or take a rule that does "
                                "not ask for it, such as aicc");
}
void require_periodogram(AlphaRule rule, const FilterFrame& frame) {
  if (lacks_periodogram(rule, frame))
    throw std::invalid_argument("the rule " + std::string(name(rule)) +
                                " needs the spectrum of the readings along a line of taxels, which "
                                "a skin's frame has not: take another rule, such as aicc");
}

}  // namespace tactile_net

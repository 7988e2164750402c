#include "tactile_net/inverse/alpha.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inverse/alpha_search.hpp"
#include "numeric/named.hpp"

namespace tactile_net {
namespace {

[[nodiscard]] FoundAlpha candidate(Criteria& criteria, const AlphaTables::Parts& tables,
                                   AlphaRule rule, std::span<const double> values) {
  if (criteria.silent()) return nothing_to_choose(tables);
  return search(tables, rule, values,
                [&](double log_alpha) { return criteria.zero(rule, log_alpha); });
}

constexpr Named<AlphaRule> rules[] = {{AlphaRule::rgcv, "rgcv"},
                                      {AlphaRule::gcv, "gcv"},
                                      {AlphaRule::discrepancy, "discrepancy"},
                                      {AlphaRule::l_curve, "l_curve"},
                                      {AlphaRule::ncp, "ncp"},
                                      {AlphaRule::gml, "gml"},
                                      {AlphaRule::evidence, "evidence"},
                                      {AlphaRule::aicc, "aicc"}};
static_assert(alpha_rules.size() == std::size(rules));

constexpr Named<AlphaVerdict> verdicts[] = {{AlphaVerdict::ok, "ok"},
                                            {AlphaVerdict::border, "border"},
                                            {AlphaVerdict::unstable, "unstable"},
                                            {AlphaVerdict::no_root, "no_root"},
                                            {AlphaVerdict::rules_disagree, "rules_disagree"},
                                            {AlphaVerdict::noise_needed, "noise_needed"}};

}  // namespace

void ResidualPeriodogram::powers(std::span<const double> left, std::size_t components,
                                 std::span<double> values) const {
  const std::vector<double> still(components);
  std::vector<double> slopes(size());
  for (std::size_t i = 0; i * components < left.size(); ++i)
    power(left.subspan(i * components, components), still, values.subspan(i * size(), size()),
          slopes);
}

std::string_view name(AlphaRule rule) noexcept { return name_in<rules>(rule); }

std::string_view name(AlphaVerdict verdict) noexcept { return name_in<verdicts>(verdict); }

const AlphaChoice& AlphaSweep::choice(AlphaRule rule) const {
  for (const Curve& curve : curves)
    if (curve.rule == rule) return curve.choice;
  throw std::out_of_range("the rule " + std::string(name(rule)) +
                          " is not in this sweep: it needs " +
                          (needs_noise(rule) ? "the rms of the noise"
                                             : "the spectrum of readings along a line of taxels"));
}

AlphaSweep sweep_alpha(const FilterFrame& frame, std::optional<double> noise_rms) {
  return sweep_alpha(frame, AlphaTables(frame.gamma, frame.rows, frame.shares), noise_rms);
}

AlphaSweep sweep_alpha(const FilterFrame& frame, const AlphaTables& made,
                       std::optional<double> noise_rms) {
  const AlphaTables::Parts& tables = made.parts();
  Criteria criteria(frame, tables, noise_rms);
  AlphaSweep sweep{.alphas = tables.alphas};

  std::vector<FoundAlpha> candidates;
  for (const AlphaRule rule : alpha_rules) {
    if (lacks_noise(rule, noise_rms) || lacks_periodogram(rule, frame)) continue;
    AlphaSweep::Curve curve{.rule = rule, .values = criteria.values(rule)};
    candidates.push_back(candidate(criteria, tables, rule, curve.values));
    if (rule == AlphaRule::discrepancy)
      for (double& value : curve.values) value = std::abs(value);
    sweep.curves.push_back(std::move(curve));
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::vector<double> others;
    for (std::size_t j = 0; j < candidates.size(); ++j)
      if (j != i && trusted(tables, sweep.curves[j].rule))
        others.push_back(candidates[j].log_alpha);
    const AlphaRule rule = sweep.curves[i].rule;
    sweep.curves[i].choice = {rule, tables.alpha(candidates[i].log_alpha),
                              judge(criteria, tables, rule, candidates[i], std::move(others))};
  }
  return sweep;
}

AlphaChoice choose_alone(const FilterFrame& frame, AlphaRule rule,
                         std::optional<double> noise_rms) {
  return choose_alone(frame, AlphaTables(frame.gamma, frame.rows, frame.shares), rule, noise_rms);
}

AlphaChoice choose_alone(const FilterFrame& frame, const AlphaTables& tables, AlphaRule rule,
                         std::optional<double> noise_rms) {
  require_noise(rule, noise_rms);
  require_periodogram(rule, frame);
  const AlphaTables::Parts& parts = tables.parts();
  Criteria criteria(frame, parts, noise_rms);
  const FoundAlpha one = candidate(criteria, parts, rule, criteria.values(rule));
  return {rule, parts.alpha(one.log_alpha), judge(criteria, parts, rule, one, {})};
}

AlphaChoice choose_alpha(const FilterFrame& frame, AlphaRule rule,
                         std::optional<double> noise_rms) {
  require_noise(rule, noise_rms);
  require_periodogram(rule, frame);
  return sweep_alpha(frame, noise_rms).choice(rule);
}

}  // namespace tactile_net

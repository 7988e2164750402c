#include "tactile_net/inverse/alpha.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <stdexcept>

#include "inverse/alpha_criteria.hpp"
#include "numeric/named.hpp"

namespace tactile_net {
namespace {

/// One rule's answer before the others are heard.
struct Candidate {
  double log_alpha = 0.0;
  AlphaVerdict verdict = AlphaVerdict::ok;
};

/// The root of `function` between two alpha_steps, to the last digit.
double root(const auto& function, double from, double to) {
  const double at_from = function(from);
  const double at_to = function(to);
  if (at_from == 0.0) return from;
  if (at_to == 0.0) return to;
  std::uintmax_t calls = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      function, from, to, at_from, at_to, boost::math::tools::eps_tolerance<double>(50), calls);
  return 0.5 * (low + high);
}

Candidate least(Criteria& criteria, AlphaRule rule, const std::vector<double>& values) {
  std::size_t best = alpha_steps;
  for (std::size_t i = 0; i < alpha_steps; ++i)
    if (std::isfinite(values[i]) && (best == alpha_steps || values[i] < values[best])) best = i;
  if (best == alpha_steps) return {criteria.at(alpha_steps - 1), AlphaVerdict::no_root};
  if (best == 0 || best == alpha_steps - 1) return {criteria.at(best), AlphaVerdict::border};
  const auto slope = [&](double log_alpha) { return criteria.slope(rule, log_alpha); };
  const double from = criteria.at(best - 1);
  const double to = criteria.at(best + 1);
  if (!(slope(from) < 0.0 && slope(to) > 0.0)) return {criteria.at(best), AlphaVerdict::ok};
  return {root(slope, from, to), AlphaVerdict::ok};
}

Candidate crossing(Criteria& criteria, const std::vector<double>& values) {
  // rho rises with alpha.
  if (!(values.front() <= 0.0)) return {criteria.at(0), AlphaVerdict::no_root};
  if (!(values.back() >= 0.0)) return {criteria.at(alpha_steps - 1), AlphaVerdict::no_root};
  const auto above = std::upper_bound(values.begin(), values.end(), 0.0);
  const auto next = static_cast<std::size_t>(
      std::min(above - values.begin(), static_cast<std::ptrdiff_t>(alpha_steps - 1)));
  const auto value = [&](double log_alpha) { return criteria.misfit(log_alpha); };
  return {root(value, criteria.at(next - 1), criteria.at(next)), AlphaVerdict::ok};
}

Candidate candidate(Criteria& criteria, AlphaRule rule, const std::vector<double>& values) {
  if (criteria.silent()) return {criteria.at(alpha_steps - 1), AlphaVerdict::no_root};
  return rule == AlphaRule::discrepancy ? crossing(criteria, values)
                                        : least(criteria, rule, values);
}

/// The verdict of one candidate among all: the traction must not differ by more than half from
/// that of the median alpha of the others.
AlphaVerdict judge(const Criteria& criteria, const Candidate& one, std::vector<double> others) {
  if (one.verdict != AlphaVerdict::ok) return one.verdict;
  if (criteria.difference(one.log_alpha, one.log_alpha + std::log(10.0)) > 1.0)
    return AlphaVerdict::unstable;
  if (others.empty()) return one.verdict;
  const auto middle = others.begin() + std::ssize(others) / 2;
  std::nth_element(others.begin(), middle, others.end());
  return criteria.difference(one.log_alpha, *middle) > 0.5 ? AlphaVerdict::rules_disagree
                                                           : AlphaVerdict::ok;
}

void require_noise(AlphaRule rule, std::optional<double> noise_rms) {
  if (rule == AlphaRule::discrepancy && !noise_rms)
    throw std::invalid_argument("the rule discrepancy needs the noise's rms");
}

constexpr Named<AlphaRule> rules[] = {{AlphaRule::rgcv, "rgcv"},
                                      {AlphaRule::gcv, "gcv"},
                                      {AlphaRule::discrepancy, "discrepancy"},
                                      {AlphaRule::l_curve, "l_curve"},
                                      {AlphaRule::ncp, "ncp"},
                                      {AlphaRule::gml, "gml"}};
static_assert(alpha_rules.size() == std::size(rules));

constexpr Named<AlphaVerdict> verdicts[] = {{AlphaVerdict::ok, "ok"},
                                            {AlphaVerdict::border, "border"},
                                            {AlphaVerdict::unstable, "unstable"},
                                            {AlphaVerdict::no_root, "no_root"},
                                            {AlphaVerdict::rules_disagree, "rules_disagree"}};

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

std::optional<AlphaRule> alpha_rule_named(std::string_view text) noexcept {
  return named_in<rules>(text);
}

std::string_view name(AlphaVerdict verdict) noexcept { return name_in<verdicts>(verdict); }

const AlphaChoice& AlphaSweep::choice(AlphaRule rule) const {
  for (const Curve& curve : curves)
    if (curve.rule == rule) return curve.choice;
  throw std::out_of_range("the rule " + std::string(name(rule)) + " needs the noise's rms");
}

AlphaSweep sweep_alpha(const FilterFrame& frame, std::optional<double> noise_rms) {
  return sweep_alpha(frame, AlphaTables(frame.gamma, frame.rows), noise_rms);
}

AlphaSweep sweep_alpha(const FilterFrame& frame, const AlphaTables& tables,
                       std::optional<double> noise_rms) {
  Criteria criteria(frame, tables.parts(), noise_rms);
  AlphaSweep sweep;
  for (std::size_t i = 0; i < alpha_steps; ++i)
    sweep.alphas.push_back(criteria.alpha(criteria.at(i)));

  std::vector<Candidate> candidates;
  for (const AlphaRule rule : alpha_rules) {
    if (rule == AlphaRule::discrepancy && !noise_rms) continue;
    if (rule == AlphaRule::ncp && !frame.periodogram) continue;
    AlphaSweep::Curve curve{.rule = rule, .values = criteria.values(rule)};
    candidates.push_back(candidate(criteria, rule, curve.values));
    if (rule == AlphaRule::discrepancy)
      for (double& value : curve.values) value = std::abs(value);
    sweep.curves.push_back(std::move(curve));
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::vector<double> others;
    for (std::size_t j = 0; j < candidates.size(); ++j)
      if (j != i) others.push_back(candidates[j].log_alpha);
    sweep.curves[i].choice = {sweep.curves[i].rule, criteria.alpha(candidates[i].log_alpha),
                              judge(criteria, candidates[i], std::move(others))};
  }
  return sweep;
}

AlphaChoice choose_alone(const FilterFrame& frame, AlphaRule rule,
                         std::optional<double> noise_rms) {
  return choose_alone(frame, AlphaTables(frame.gamma, frame.rows), rule, noise_rms);
}

AlphaChoice choose_alone(const FilterFrame& frame, const AlphaTables& tables, AlphaRule rule,
                         std::optional<double> noise_rms) {
  require_noise(rule, noise_rms);
  Criteria criteria(frame, tables.parts(), noise_rms);
  const Candidate one = candidate(criteria, rule, criteria.values(rule));
  return {rule, criteria.alpha(one.log_alpha), judge(criteria, one, {})};
}

AlphaChoice choose_alpha(const FilterFrame& frame, AlphaRule rule,
                         std::optional<double> noise_rms) {
  require_noise(rule, noise_rms);
  return sweep_alpha(frame, noise_rms).choice(rule);
}

}  // namespace tactile_net

#include "tactile_net/inverse/alpha.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t steps = 200;
constexpr double robustness = 0.1;   // Lukas' gamma
constexpr double safety = 1.01;      // of the discrepancy
constexpr double resolution = 64.0;  // units of rounding per row below which gamma means nothing

/// A rule's value and its slope in log alpha.
struct Point {
  double value = 0.0;
  double slope = 0.0;
};

/// Sums over the components at one alpha. Lengths are squares over the frame's scale.
struct Sums {
  double residual = 0.0, residual_slope = 0.0;  // rho^2
  double fit = 0.0, fit_slope = 0.0;            // g'(I - H) g
  double trace = 0.0, trace_slope = 0.0;        // tr H
  double square = 0.0, square_slope = 0.0;      // tr H^2
  double log_determinant = 0.0;                 // of I - H; its slope is tr H
};

/// What every rule is a function of: the frame, over gamma's largest value.
class Criteria {
 public:
  Criteria(const FilterFrame& frame, std::optional<double> noise_rms)
      : frame_(frame), rows_(static_cast<double>(frame.rows)) {
    if (frame.gamma.empty()) throw std::invalid_argument("a frame without components");
    if (noise_rms && !(*noise_rms >= 0.0)) throw std::invalid_argument("noise_rms must be >= 0");
    largest_ = *std::max_element(frame.gamma.begin(), frame.gamma.end());
    if (noise_rms && frame.scale > 0.0)
      target_ = safety * (*noise_rms / frame.scale) * std::sqrt(rows_);
    relative_.reserve(frame.gamma.size());
    for (const double gamma : frame.gamma)
      relative_.push_back(largest_ > 0.0 ? gamma / largest_ : 0.0);
    const double smallest = *std::min_element(relative_.begin(), relative_.end());
    const double floor = resolution * rows_ * std::numeric_limits<double>::epsilon();
    low_ = 2.0 * std::log(std::max(smallest, std::min(floor, 0.1)));
    if (!(low_ < -1.0)) low_ = -1.0;  // all gamma equal: a bracket needs a width
    left_.resize(relative_.size());
    change_.resize(relative_.size());
    if (frame.periodogram) {
      power_.resize(frame.periodogram->size());
      power_slope_.resize(power_.size());
    }
  }

  [[nodiscard]] bool silent() const noexcept { return !(frame_.scale > 0.0) || !(largest_ > 0.0); }
  [[nodiscard]] double at(std::size_t step) const noexcept {
    return low_ * (1.0 - static_cast<double>(step) / (steps - 1.0));
  }
  [[nodiscard]] double alpha(double log_alpha) const noexcept {
    const double root = largest_ * std::exp(0.5 * log_alpha);
    return root * root;
  }

  [[nodiscard]] Point of(AlphaRule rule, double log_alpha) {
    switch (rule) {
      case AlphaRule::rgcv:
      case AlphaRule::gcv:
      case AlphaRule::discrepancy:
      case AlphaRule::gml:
        return from_sums(rule, log_alpha);
      case AlphaRule::l_curve:
        return {-curvature<double>(log_alpha),
                -curvature<std::complex<double>>({log_alpha, step_}).imag() / step_};
      case AlphaRule::ncp:
        return whiteness(log_alpha);
    }
    return {};
  }

  /// |L (f_a - f_b)| / |L f_b| for two alphas.
  [[nodiscard]] double difference(double log_a, double log_b) const {
    double apart = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < relative_.size(); ++i) {
      const double g = relative_[i];
      const double a = g / (g * g + std::exp(log_a)) * frame_.beta[i];
      const double b = g / (g * g + std::exp(log_b)) * frame_.beta[i];
      apart += (a - b) * (a - b);
      size += b * b;
    }
    return std::sqrt(apart / size);
  }

 private:
  [[nodiscard]] Sums sums(double log_alpha) const {
    Sums s;
    const double alpha = std::exp(log_alpha);
    s.residual = s.fit = frame_.outside * frame_.outside;
    for (std::size_t i = 0; i < relative_.size(); ++i) {
      const double square = relative_[i] * relative_[i];
      const double kept = square / (square + alpha);
      const double lost = alpha / (square + alpha);
      const double power = frame_.beta[i] * frame_.beta[i];
      s.residual += lost * lost * power;
      s.residual_slope += 2.0 * kept * lost * lost * power;
      s.fit += lost * power;
      s.fit_slope += kept * lost * power;
      s.trace += kept;
      s.trace_slope -= kept * lost;
      s.square += kept * kept;
      s.square_slope -= 2.0 * kept * kept * lost;
      s.log_determinant += std::log(lost);
    }
    return s;
  }

  [[nodiscard]] Point from_sums(AlphaRule rule, double log_alpha) const {
    const Sums s = sums(log_alpha);
    const Point rho{std::log(s.residual), s.residual_slope / s.residual};
    if (rule == AlphaRule::discrepancy)
      return {0.5 * rho.value - std::log(target_), 0.5 * rho.slope};
    if (rule == AlphaRule::gml)
      return {std::log(s.fit) - s.log_determinant / rows_, s.fit_slope / s.fit - s.trace / rows_};
    const double free = rows_ - s.trace;
    Point gcv{rho.value - 2.0 * std::log(free), rho.slope + 2.0 * s.trace_slope / free};
    if (rule == AlphaRule::gcv) return gcv;
    const double weight = robustness + (1.0 - robustness) * s.square / rows_;
    gcv.value += std::log(weight);
    gcv.slope += (1.0 - robustness) * s.square_slope / rows_ / weight;
    return gcv;
  }

  /// Of (log rho, log |L f|): Hansen 2010, 5.3, with lambda^2 = alpha. An analytic function, so
  /// that a complex step gives its slope without a difference.
  template <class Number>
  [[nodiscard]] Number curvature(const Number& log_alpha) const {
    const Number alpha = std::exp(log_alpha);
    Number eta = 0.0;                              // |L f|^2
    Number rho = frame_.outside * frame_.outside;  // |W (K f - g)|^2
    Number rate = 0.0;                             // lambda d eta / d lambda
    for (std::size_t i = 0; i < relative_.size(); ++i) {
      const double square = relative_[i] * relative_[i];
      const double power = frame_.beta[i] * frame_.beta[i];
      const Number lost = alpha / (square + alpha);
      const Number size = square / ((square + alpha) * (square + alpha)) * power;
      eta += size;
      rho += lost * lost * power;
      rate -= 4.0 * lost * size;
    }
    const Number denominator = alpha * alpha * eta * eta + rho * rho;
    return 2.0 * eta * rho / rate *
           (alpha * rate * rho + 2.0 * alpha * eta * rho + alpha * alpha * eta * rate) /
           (denominator * std::sqrt(denominator));
  }

  [[nodiscard]] Point whiteness(double log_alpha) {
    const double alpha = std::exp(log_alpha);
    for (std::size_t i = 0; i < relative_.size(); ++i) {
      const double square = relative_[i] * relative_[i];
      const double lost = alpha / (square + alpha);
      left_[i] = lost * frame_.beta[i];
      change_[i] = lost * square / (square + alpha) * frame_.beta[i];
    }
    frame_.periodogram->power(left_, change_, power_, power_slope_);
    double total = 0.0;
    double total_slope = 0.0;
    for (std::size_t k = 0; k < power_.size(); ++k) {
      total += power_[k];
      total_slope += power_slope_[k];
    }
    Point distance;
    double sum = 0.0;
    double sum_slope = 0.0;
    for (std::size_t k = 0; k < power_.size(); ++k) {
      sum += power_[k];
      sum_slope += power_slope_[k];
      const double line = static_cast<double>(k + 1) / static_cast<double>(power_.size());
      const double off = sum / total - line;
      distance.value += off * off;
      distance.slope += 2.0 * off * (sum_slope - sum / total * total_slope) / total;
    }
    return distance;
  }

  const FilterFrame& frame_;
  double rows_;
  double largest_ = 0.0;
  double low_ = 0.0;  // log of the smallest alpha, over largest^2; the largest is 0
  double target_ = 0.0;
  std::vector<double> relative_;
  std::vector<double> left_, change_, power_, power_slope_;
  static constexpr double step_ = 1e-100;
};

/// One rule's answer before the others are heard.
struct Candidate {
  double log_alpha = 0.0;
  AlphaVerdict verdict = AlphaVerdict::ok;
};

std::vector<double> values_of(Criteria& criteria, AlphaRule rule) {
  std::vector<double> values(steps);
  for (std::size_t i = 0; i < steps; ++i) values[i] = criteria.of(rule, criteria.at(i)).value;
  return values;
}

/// The root of `function` between two steps, to the last digit.
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
  std::size_t best = steps;
  for (std::size_t i = 0; i < steps; ++i)
    if (std::isfinite(values[i]) && (best == steps || values[i] < values[best])) best = i;
  if (best == steps) return {criteria.at(steps - 1), AlphaVerdict::no_root};
  if (best == 0 || best == steps - 1) return {criteria.at(best), AlphaVerdict::border};
  const auto slope = [&](double log_alpha) { return criteria.of(rule, log_alpha).slope; };
  const double from = criteria.at(best - 1);
  const double to = criteria.at(best + 1);
  if (!(slope(from) < 0.0 && slope(to) > 0.0)) return {criteria.at(best), AlphaVerdict::ok};
  return {root(slope, from, to), AlphaVerdict::ok};
}

Candidate crossing(Criteria& criteria, const std::vector<double>& values) {
  // rho rises with alpha.
  if (!(values.front() <= 0.0)) return {criteria.at(0), AlphaVerdict::no_root};
  if (!(values.back() >= 0.0)) return {criteria.at(steps - 1), AlphaVerdict::no_root};
  const auto above = std::upper_bound(values.begin(), values.end(), 0.0);
  const auto next = static_cast<std::size_t>(
      std::min(above - values.begin(), static_cast<std::ptrdiff_t>(steps - 1)));
  const auto value = [&](double log_alpha) {
    return criteria.of(AlphaRule::discrepancy, log_alpha).value;
  };
  return {root(value, criteria.at(next - 1), criteria.at(next)), AlphaVerdict::ok};
}

Candidate candidate(Criteria& criteria, AlphaRule rule, const std::vector<double>& values) {
  if (criteria.silent()) return {criteria.at(steps - 1), AlphaVerdict::no_root};
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
  Criteria criteria(frame, noise_rms);
  AlphaSweep sweep;
  for (std::size_t i = 0; i < steps; ++i) sweep.alphas.push_back(criteria.alpha(criteria.at(i)));

  std::vector<Candidate> candidates;
  for (const AlphaRule rule : alpha_rules) {
    if (rule == AlphaRule::discrepancy && !noise_rms) continue;
    if (rule == AlphaRule::ncp && !frame.periodogram) continue;
    AlphaSweep::Curve curve{.rule = rule, .values = values_of(criteria, rule)};
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
  require_noise(rule, noise_rms);
  Criteria criteria(frame, noise_rms);
  const Candidate one = candidate(criteria, rule, values_of(criteria, rule));
  return {rule, criteria.alpha(one.log_alpha), judge(criteria, one, {})};
}

AlphaChoice choose_alpha(const FilterFrame& frame, AlphaRule rule,
                         std::optional<double> noise_rms) {
  require_noise(rule, noise_rms);
  return sweep_alpha(frame, noise_rms).choice(rule);
}

}  // namespace tactile_net

#include "inverse/alpha_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double safety = 1.01;  // of the discrepancy

/// Of (log rho, log |L f|): Hansen 2010, 5.3, with lambda^2 = alpha. An analytic function, so that
/// a complex step gives its slope without a difference.
///
/// @param eta   |L f|^2
/// @param rho   |W (K f - g)|^2
/// @param rate  lambda d eta / d lambda
template <class Number>
Number curvature(const Number& alpha, const Number& eta, const Number& rho, const Number& rate) {
  const Number denominator = alpha * alpha * eta * eta + rho * rho;
  return 2.0 * eta * rho / rate *
         (alpha * rate * rho + 2.0 * alpha * eta * rho + alpha * alpha * eta * rate) /
         (denominator * std::sqrt(denominator));
}

}  // namespace

void check_family(const FilterFrame& frame, const AlphaTables::Parts& tables) {
  if (frame.gamma != tables.gamma || frame.shares != tables.shares || frame.rows != tables.rows)
    throw std::invalid_argument("the tables for alpha are of another family than the frame");
  const std::size_t count = frame.gamma.size();
  if (frame.beta.size() != count || !(frame.powers.empty() || frame.powers.size() == count))
    throw std::invalid_argument("a frame needs one beta a gamma, and as many powers or none");
}

Criteria::Criteria(const FilterFrame& frame, const AlphaTables::Parts& tables,
                   std::optional<double> noise_rms)
    : frame_(frame), tables_(tables), rows_(static_cast<double>(frame.rows)) {
  check_family(frame, tables);
  if (noise_rms && !(*noise_rms >= 0.0)) throw std::invalid_argument("noise_rms must be >= 0");
  if (noise_rms && frame.scale > 0.0) noise_ = *noise_rms / frame.scale;
  power_of_ = frame.powers;
  if (power_of_.empty())
    for (const double beta : frame.beta) power_of_.push_back(beta * beta);
  left_.resize(frame.beta.size());
  change_.resize(frame.beta.size());
  if (frame.periodogram) {
    power_.resize(frame.periodogram->size());
    power_slope_.resize(power_.size());
  }
}

const FrameCurves& Criteria::curves() {
  if (!curves_) {
    const Eigen::VectorXd all = tables_.weights * as_eigen(std::span<const double>(power_of_));
    const double outside = frame_.outside * frame_.outside;
    const Eigen::VectorXd residual = all.segment(0, alpha_count).array() + outside;
    curves_ = FrameCurves{.residual = residual,
                          .log_residual = residual.array().log(),
                          .fit = all.segment(alpha_count, alpha_count).array() + outside,
                          .size = all.segment(2 * alpha_count, alpha_count),
                          .rate = all.segment(3 * alpha_count, alpha_count)};
  }
  return *curves_;
}

double Criteria::log_target() const { return std::log(safety * noise_ * std::sqrt(rows_)); }

std::vector<double> Criteria::values(AlphaRule rule) {
  if (rule == AlphaRule::ncp) return whiteness();
  const FrameCurves& sums = curves();
  std::vector<double> values(alpha_steps);
  Eigen::Map<Eigen::VectorXd> all(values.data(), alpha_count);
  const Eigen::VectorXd& penalty = tables_.penalties[index(rule)];
  switch (rule) {
    case AlphaRule::discrepancy:
      all = 0.5 * sums.log_residual.array() - log_target();
      break;
    case AlphaRule::gml:
      all = sums.fit.array().log() + penalty.array();
      break;
    case AlphaRule::evidence:
      all = 0.5 / (noise_ * noise_) * sums.fit + penalty;
      break;
    case AlphaRule::l_curve:
      for (Eigen::Index a = 0; a < alpha_count; ++a)
        all(a) =
            -curvature(tables_.relative_alphas(a), sums.size(a), sums.residual(a), sums.rate(a));
      break;
    default:
      all = sums.log_residual + penalty;
  }
  return values;
}

double Criteria::zero(AlphaRule rule, double log_alpha) {
  if (rule == AlphaRule::ncp) return whiteness_slope(log_alpha);
  if (rule == AlphaRule::l_curve) return -curvature_slope(log_alpha);
  return zero_from_sums(rule, log_alpha);
}

double Criteria::zero_from_sums(AlphaRule rule, double log_alpha) const {
  const double alpha = std::exp(log_alpha);
  double residual = frame_.outside * frame_.outside;
  double fit = residual;
  double residual_slope = 0.0, fit_slope = 0.0;
  Traces traces{.left = tables_.unexplained};
  double trace_slope = 0.0, square_slope = 0.0;
  for (std::size_t i = 0; i < power_of_.size(); ++i) {
    const double square = tables_.relative[i] * tables_.relative[i];
    const double over = 1.0 / (square + alpha);
    const double kept = square * over;
    const double lost = alpha * over;
    const double power = power_of_[i];
    residual += lost * lost * power;
    residual_slope += 2.0 * kept * lost * lost * power;
    fit += lost * power;
    fit_slope += kept * lost * power;
    const double share = tables_.share(i);
    traces.kept += share * kept;
    if (square > 0.0) traces.left += share * lost;
    traces.square += share * kept * kept;
    trace_slope -= share * kept * lost;
    square_slope -= 2.0 * share * kept * kept * lost;
  }
  const double rho_slope = residual_slope / residual;
  switch (rule) {
    case AlphaRule::discrepancy:
      return 0.5 * std::log(residual) - log_target();
    case AlphaRule::gml:
      return fit_slope / fit - traces.kept / rows_;
    case AlphaRule::evidence:
      return 0.5 * (fit_slope / (noise_ * noise_) - traces.kept);
    case AlphaRule::aicc:
      return rho_slope + 2.0 * (rows_ - 1.0) * trace_slope / std::pow(traces.left - 2.0, 2);
    case AlphaRule::gcv:
      return rho_slope + 2.0 * trace_slope / traces.left;
    default:
      return rho_slope + 2.0 * trace_slope / traces.left +
             0.9 * square_slope / rows_ / robustness(traces, rows_);
  }
}

double Criteria::curvature_slope(double log_alpha) const {
  const double alpha = std::exp(log_alpha);
  double eta = 0.0, eta_slope = 0.0;
  double rho = frame_.outside * frame_.outside, rho_slope = 0.0;
  double rate = 0.0, rate_slope = 0.0;
  for (std::size_t i = 0; i < power_of_.size(); ++i) {
    const double square = tables_.relative[i] * tables_.relative[i];
    const double over = 1.0 / (square + alpha);
    const double kept = square * over;
    const double lost = alpha * over;
    const double size = kept * over * power_of_[i];
    eta += size;
    eta_slope -= 2.0 * lost * size;
    rho += lost * lost * power_of_[i];
    rho_slope += 2.0 * kept * lost * lost * power_of_[i];
    rate -= 4.0 * lost * size;
    rate_slope -= 4.0 * lost * size * (kept - 2.0 * lost);
  }
  constexpr double step = 1e-100;
  using Complex = std::complex<double>;
  const Complex stepped = curvature<Complex>({alpha, step * alpha}, {eta, step * eta_slope},
                                             {rho, step * rho_slope}, {rate, step * rate_slope});
  return stepped.imag() / step;
}

std::vector<double> Criteria::whiteness() const {
  const Eigen::MatrixXd left =
      as_eigen(std::span<const double>(frame_.beta)).asDiagonal() * tables_.lost;
  const std::size_t bins = power_.size();
  std::vector<double> powers(alpha_steps * bins);
  frame_.periodogram->powers({left.data(), static_cast<std::size_t>(left.size())},
                             frame_.beta.size(), powers);
  std::vector<double> values(alpha_steps);
  for (std::size_t a = 0; a < alpha_steps; ++a) {
    const auto power = std::span(powers).subspan(a * bins, bins);
    double total = 0.0;
    for (const double one : power) total += one;
    double sum = 0.0;
    for (std::size_t k = 0; k < bins; ++k) {
      sum += power[k];
      const double off = sum / total - static_cast<double>(k + 1) / static_cast<double>(bins);
      values[a] += off * off;
    }
  }
  return values;
}

double Criteria::whiteness_slope(double log_alpha) {
  const double alpha = std::exp(log_alpha);
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const double square = tables_.relative[i] * tables_.relative[i];
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
  double slope = 0.0;
  double sum = 0.0;
  double sum_slope = 0.0;
  for (std::size_t k = 0; k < power_.size(); ++k) {
    sum += power_[k];
    sum_slope += power_slope_[k];
    const double line = static_cast<double>(k + 1) / static_cast<double>(power_.size());
    slope += 2.0 * (sum / total - line) * (sum_slope - sum / total * total_slope) / total;
  }
  return slope;
}

double Criteria::difference(double log_a, double log_b) const {
  const double alpha_a = std::exp(log_a);
  const double alpha_b = std::exp(log_b);
  double apart = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < tables_.relative.size(); ++i) {
    const double g = tables_.relative[i];
    const double a = g / (g * g + alpha_a);
    const double b = g / (g * g + alpha_b);
    apart += (a - b) * (a - b) * power_of_[i];
    size += b * b * power_of_[i];
  }
  return std::sqrt(apart / size);
}

}  // namespace tactile_net

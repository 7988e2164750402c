#include "tactile_net/inverse/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/family_factors.hpp"
#include "inverse/line_stabiliser.hpp"
#include "inverse/significance.hpp"
#include "inverse/weighting.hpp"
#include "realtime/line_contacts.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net {

std::vector<double> Covariance::deviations_of(std::span<const std::vector<double>> weights) const {
  std::vector<double> all;
  for (const std::vector<double>& one : weights) all.push_back(deviation(one));
  return all;
}

Matrix Covariance::covariances(std::span<const std::vector<double>> weights) const {
  const std::size_t count = weights.size();
  Matrix all{count, count, std::vector<double>(count * count)};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j <= i; ++j) all(i, j) = all(j, i) = covariance(weights[i], weights[j]);
  return all;
}

/// C = sigma^2 S S'.
struct TractionCovariance::Factor {
  Factor(Eigen::MatrixXd s, double degrees_of_freedom)
      : root(std::move(s)), degrees(degrees_of_freedom) {}

  /// Of tractions that are all certain.
  explicit Factor(Eigen::Index tractions) : root(Eigen::MatrixXd::Zero(tractions, 0)) {}

  /// @param form  of the free variables
  Factor(const StandardForm& form, double alpha, double prior_alpha) {
    check_alpha(alpha);
    check_alpha(prior_alpha);
    const double smoothing = std::sqrt(alpha);
    Eigen::VectorXd size(form.gamma.size());
    for (Eigen::Index i = 0; i < size.size(); ++i) {
      // Noise gamma / (gamma^2 + alpha), and what is smoothed away alpha / (gamma^2 + alpha) of a
      // prior whose deviation is 1 / sqrt(prior_alpha).
      const double gamma = form.gamma(i);
      const double whole = std::hypot(gamma, smoothing);
      size(i) = std::hypot(gamma, smoothing * (smoothing / std::sqrt(prior_alpha))) / whole / whole;
      degrees += (gamma / whole) * (gamma / whole);
    }
    const Eigen::MatrixXd known = form.from_components(Eigen::MatrixXd(size.asDiagonal()));
    if (form.v.rows() == form.v.cols()) {
      root = known;
      return;
    }
    // What no reading shows is as large as the prior says: 1 / sqrt(prior_alpha) on the complement
    // of V, whose projector is its own square.
    const Eigen::Index n = form.v.rows();
    Eigen::MatrixXd hidden = Eigen::MatrixXd::Identity(n, n) - form.v * form.v.transpose();
    hidden = form.tractions_of(hidden) / std::sqrt(prior_alpha);
    root.resize(hidden.rows(), known.cols() + n);
    root << known, hidden;
  }
  Eigen::MatrixXd root;  // S
  double degrees = 0.0;
};

TractionCovariance::TractionCovariance(const TikhonovFamily& family, double alpha,
                                       double prior_alpha)
    : factor_(std::make_unique<const Factor>(family.factors().form, alpha, prior_alpha)) {}

TractionCovariance::TractionCovariance(const LinearProblem& problem, double alpha,
                                       double prior_alpha)
    : factor_(std::make_unique<const Factor>(StandardForm(problem), alpha, prior_alpha)) {}

TractionCovariance::TractionCovariance(const LinearProblem& problem, double alpha,
                                       double prior_alpha, const Constraints& constraints,
                                       std::span<const std::size_t> free) {
  check_alpha(alpha);
  check_alpha(prior_alpha);
  if (free.empty())
    factor_ = std::make_unique<const Factor>(static_cast<Eigen::Index>(problem.kernel.columns));
  else
    factor_ = std::make_unique<const Factor>(
        TikhonovFamily(problem, constraints, free).factors().form, alpha, prior_alpha);
}

TractionCovariance::TractionCovariance(const Matrix& root, double degrees_of_freedom)
    : factor_(std::make_unique<const Factor>(as_eigen(root), degrees_of_freedom)) {}

TractionCovariance::TractionCovariance(std::span<const MixtureTerm> terms) {
  if (terms.empty()) throw std::invalid_argument("a covariance of no estimate");
  const Eigen::Index rows = terms.front().covariance->factor_->root.rows();
  Eigen::MatrixXd root(rows, 0);
  double degrees = 0.0;
  for (const auto& [probability, covariance, difference] : terms) {
    const Factor& factor = *covariance->factor_;
    if (factor.root.rows() != rows || std::ssize(difference) != rows)
      throw std::invalid_argument("covariances of estimates that differ in size");
    const Eigen::Index first = root.cols();
    const double share = std::sqrt(probability);
    root.conservativeResize(rows, first + factor.root.cols() + 1);
    root.middleCols(first, factor.root.cols()) = share * factor.root;
    root.rightCols<1>() = share * as_eigen(std::span(difference));
    degrees += probability * factor.degrees;
  }
  factor_ = std::make_unique<const Factor>(std::move(root), degrees);
}

TractionCovariance::~TractionCovariance() = default;
TractionCovariance::TractionCovariance(TractionCovariance&&) noexcept = default;
TractionCovariance& TractionCovariance::operator=(TractionCovariance&&) noexcept = default;

std::vector<double> TractionCovariance::deviations() const {
  const Eigen::VectorXd norms = factor_->root.rowwise().norm();
  return {norms.begin(), norms.end()};
}

double TractionCovariance::deviation(std::span<const double> weights) const {
  check_weights(weights, static_cast<std::size_t>(factor_->root.rows()));
  return (factor_->root.transpose() * as_eigen(weights)).norm();
}

double TractionCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  check_weights(a, static_cast<std::size_t>(factor_->root.rows()));
  check_weights(b, static_cast<std::size_t>(factor_->root.rows()));
  return (factor_->root.transpose() * as_eigen(a)).dot(factor_->root.transpose() * as_eigen(b));
}

double TractionCovariance::degrees_of_freedom() const noexcept { return factor_->degrees; }

double residual_norm(const LinearProblem& problem, std::span<const double> readings,
                     std::span<const double> tractions) {
  const std::vector<double> rows = weighted(problem, readings);
  check_tractions(tractions, problem.kernel.columns);
  const auto g = as_eigen(std::span(rows));
  // Squares of what has been divided by its size are numbers in any unit.
  const Eigen::VectorXd left = as_eigen(problem.kernel) * as_eigen(tractions) - g;
  const double scale = left.cwiseAbs().maxCoeff();
  return scale > 0.0 && std::isfinite(scale) ? (left / scale).norm() * scale : scale;
}

NoiseEstimate estimate_noise(const LinearProblem& problem, std::span<const double> readings,
                             std::span<const double> tractions, double degrees_of_freedom,
                             std::optional<double> stated_rms) {
  const double left = residual_norm(problem, readings, tractions);
  // Of a frame without any reading nothing is known.
  const std::vector<double> rows = weighted(problem, readings);
  if (as_eigen(std::span(rows)).cwiseAbs().maxCoeff() == 0.0) return {.stated_rms = stated_rms};
  return estimate_noise(left, independent_readings(problem), degrees_of_freedom, stated_rms);
}

NoiseEstimate estimate_noise(double residual, std::size_t rows, double degrees_of_freedom,
                             std::optional<double> stated_rms) {
  NoiseEstimate noise{.stated_rms = stated_rms};
  const double free = std::max(static_cast<double>(rows) - degrees_of_freedom, 1.0);
  noise.residual_rms = residual / std::sqrt(free);
  if (stated_rms) {
    const double limit = chi_squared_quantile(free, 0.01) / free;
    const double ratio = *stated_rms / noise.residual_rms;
    if (1.0 > limit * ratio * ratio)
      noise.model_rms = noise.residual_rms * std::sqrt(1.0 - ratio * ratio);
  }
  return noise;
}

UncertainResultant resultant_of(const LinearProblem& problem, std::span<const double> tractions,
                                const Covariance& covariance, double noise_rms) {
  return resultant_of(surface_of(problem.grid), tractions, covariance, noise_rms);
}

namespace {

/// Of the values from `first` to before `last`, with nothing elsewhere.
UncertainResultant resultant_between(std::size_t first, std::size_t last, const Surface& surface,
                                     std::span<const double> tractions,
                                     const Covariance& covariance, double noise_rms) {
  const std::size_t n = surface.count;
  const double d = surface.spacing;
  const bool two = tractions.size() > n;
  const Resultant sum = resultant_between(first, last, tractions.first(n),
                                          tractions.subspan(n, two ? n : std::size_t{0}), surface);
  // The gradient of each result by the tractions, made of three: F_v, F_t and the centre.
  std::array<std::vector<double>, 3> gradients;
  gradients.fill(std::vector<double>(tractions.size()));
  auto& [on_normal, on_tangential, on_centre] = gradients;
  const std::optional<double> centre = sum.centre();
  for (std::size_t i = first; i < last; ++i) {
    on_normal[i] = d;
    if (two) on_tangential[n + i] = d;
    if (centre) on_centre[i] = d * (surface.position(i) - *centre) / sum.normal;
  }
  const auto uncertain = [&](double value, std::span<const double> gradient) {
    return Uncertain{value, covariance.deviation(gradient) * noise_rms};
  };

  UncertainResultant result;
  result.normal = uncertain(sum.normal, on_normal);
  if (two) result.tangential = uncertain(sum.tangential, on_tangential);
  if (centre) result.centre = uncertain(*centre, on_centre);
  if (centre && two) {
    const double slope = sum.tangential / sum.normal;
    const double scale = 1.0 / sum.normal / (1.0 + slope * slope);
    std::vector<double> on_angle(tractions.size());
    for (std::size_t i = 0; i < tractions.size(); ++i)
      on_angle[i] = (on_tangential[i] - slope * on_normal[i]) * scale;
    result.angle = uncertain(*sum.angle(), on_angle);
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      result.covariance[3 * i + j] = result.covariance[3 * j + i] =
          covariance.covariance(gradients[i], gradients[j]) * noise_rms * noise_rms;
  return result;
}

}  // namespace

UncertainResultant resultant_of(const Surface& surface, std::span<const double> tractions,
                                const Covariance& covariance, double noise_rms) {
  return resultant_between(0, surface.count, surface, tractions, covariance, noise_rms);
}

std::optional<UncertainResultant> nearest_to_slipping(const Surface& surface,
                                                      std::span<const double> tractions,
                                                      const Covariance& covariance,
                                                      double noise_rms,
                                                      const UncertainResultant& whole) {
  constexpr double deviations = 6.0;
  const std::size_t n = surface.count;
  if (tractions.size() == n) return std::nullopt;
  const LineContact worst =
      nearest_to_slipping(tractions.data(), tractions.data() + n, n,
                          deviations * whole.normal.deviation / surface.spacing);
  if (worst.contacts < 2) return std::nullopt;
  return resultant_between(worst.first, worst.last, surface, tractions, covariance, noise_rms);
}

}  // namespace tactile_net

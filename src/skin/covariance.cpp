#include "tactile_net/skin/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/family_factors.hpp"

namespace tactile_net {

using Eigen::Index;

SkinCovariance::SkinCovariance(const SkinFamily& family, double alpha, double prior_alpha)
    : factors_(family.factors()), degrees_(family.degrees_of_freedom(alpha)) {
  check_alpha(alpha);
  check_alpha(prior_alpha);
  const double smoothing = std::sqrt(alpha);
  for (const double gamma : factors_->gamma) {
    // As TractionCovariance has it: noise, and what is smoothed away of the prior.
    const double whole = std::hypot(gamma, smoothing);
    sizes_.push_back(std::hypot(gamma, smoothing * (smoothing / std::sqrt(prior_alpha))) / whole /
                     whole);
  }
  if (factors_->coordinates->count() > std::ssize(sizes_)) hidden_ = 1.0 / std::sqrt(prior_alpha);
}

std::vector<double> SkinCovariance::deviations() const {
  const SkinCoordinates& coordinates = *factors_->coordinates;
  const Eigen::VectorXd most = coordinates.squares();
  Eigen::VectorXd known = Eigen::VectorXd::Zero(most.size());
  Eigen::VectorXd shown = known;
  Index first = 0;
  for (const auto& block : factors_->blocks) {
    Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(coordinates.count(), block.gamma.size());
    vectors(block.part.waves, Eigen::all) = block.v;
    const Eigen::MatrixXd roots = coordinates.tractions(vectors);
    const auto sizes = as_eigen(std::span(sizes_)).segment(first, block.gamma.size());
    known += (roots * sizes.asDiagonal()).rowwise().squaredNorm();
    shown += roots.rowwise().squaredNorm();
    first += block.gamma.size();
  }
  std::vector<double> result(static_cast<std::size_t>(most.size()));
  for (Index i = 0; i < most.size(); ++i) {
    const double left = std::max(most(i) - shown(i), 0.0);
    result[static_cast<std::size_t>(i)] =
        std::hypot(std::sqrt(known(i)), hidden_ * std::sqrt(left));
  }
  return result;
}

double SkinCovariance::deviation(std::span<const double> weights) const {
  double most = 0.0;  // a weight may be an area, whose square no number holds
  for (const double weight : weights) most = std::max(most, std::abs(weight));
  if (!(most > 0.0)) return 0.0;
  const Eigen::MatrixXd coordinates = factors_->coordinates->sums(as_eigen(weights) / most);
  const Eigen::MatrixXd components = factors_->components(coordinates);
  const double known = (as_eigen(std::span(sizes_)).asDiagonal() * components).norm();
  if (hidden_ == 0.0) return most * known;
  const double left = (coordinates - factors_->from_components(components)).norm();
  return most * std::hypot(known, hidden_ * left);
}

double SkinCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  Eigen::MatrixXd both(std::ssize(a), 2);
  both.col(0) = as_eigen(a);
  both.col(1) = as_eigen(b);
  const Eigen::MatrixXd coordinates = factors_->coordinates->sums(both);
  const Eigen::MatrixXd components = factors_->components(coordinates);
  const Eigen::MatrixXd scaled = as_eigen(std::span(sizes_)).asDiagonal() * components;
  const double known = scaled.col(0).dot(scaled.col(1));
  if (hidden_ == 0.0) return known;
  const Eigen::MatrixXd left = hidden_ * (coordinates - factors_->from_components(components));
  return known + left.col(0).dot(left.col(1));
}

NoiseEstimate estimate_noise(const SkinProblem& problem, std::span<const double> readings,
                             std::span<const double> tractions, double degrees_of_freedom,
                             std::optional<double> stated_rms) {
  const std::vector<double> rows = weighted(problem, readings);
  if (tractions.size() != problem.kernel.columns)
    throw std::invalid_argument("tractions need one value per column of the problem");
  const auto g = as_eigen(std::span(rows));
  const double scale = g.cwiseAbs().maxCoeff();
  if (scale == 0.0) return {.stated_rms = stated_rms};
  const Eigen::VectorXd residual =
      as_eigen(problem.kernel) * (as_eigen(tractions) / scale) - g / scale;
  return estimate_noise(residual.norm() * scale, independent_readings(problem), degrees_of_freedom,
                        stated_rms);
}

}  // namespace tactile_net

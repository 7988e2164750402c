#include "tactile_net/skin/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/family_factors.hpp"
#include "skin/scaled_deviation.hpp"
#include "skin/window_sums.hpp"

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

template <class Sums>
std::vector<double> SkinCovariance::deviations_of(const std::vector<double>& most,
                                                  const Sums& sums) const {
  const SkinCoordinates& coordinates = *factors_->coordinates;
  Eigen::VectorXd known = Eigen::VectorXd::Zero(std::ssize(most));
  Eigen::VectorXd shown = known;
  Index first = 0;
  for (const auto& block : factors_->blocks) {
    Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(coordinates.count(), block.gamma.size());
    vectors(block.part.waves, Eigen::all) = block.v;
    const Eigen::MatrixXd roots = sums(coordinates.tractions(vectors));
    const auto sizes = as_eigen(std::span(sizes_)).segment(first, block.gamma.size());
    known += (roots * sizes.asDiagonal()).rowwise().squaredNorm();
    shown += roots.rowwise().squaredNorm();
    first += block.gamma.size();
  }
  std::vector<double> result(most.size());
  for (std::size_t i = 0; i < most.size(); ++i) {
    const auto at = static_cast<Index>(i);
    const double left = std::max(most[i] - shown(at), 0.0);
    result[i] = std::hypot(std::sqrt(known(at)), hidden_ * std::sqrt(left));
  }
  return result;
}

std::vector<double> SkinCovariance::deviations() const {
  const Eigen::VectorXd most = factors_->coordinates->squares();
  return deviations_of({most.begin(), most.end()},
                       [](Eigen::MatrixXd tractions) { return tractions; });
}

std::vector<double> SkinCovariance::window_deviations(const SkinGrid& grid,
                                                      const CellWindow& window) const {
  const Eigen::VectorXd most = factors_->coordinates->squares(grid, window);
  return deviations_of({most.begin(), most.end()}, [&](const Eigen::MatrixXd& tractions) {
    Eigen::MatrixXd all = tractions.topRows(most.size());
    for (Index j = 0; j < all.cols(); ++j)
      window_sums(grid, window, std::span(all.col(j).data(), static_cast<std::size_t>(all.rows())));
    return all;
  });
}

double SkinCovariance::deviation(std::span<const double> weights) const {
  return scaled_deviation(*this, weights);
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

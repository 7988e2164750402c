#include "skin/large/coarse_space.hpp"

#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "numeric/eigen.hpp"

namespace tactile_net {

using Eigen::Index;

SkinCoarseSpace::SkinCoarseSpace(std::shared_ptr<const LowWaves> waves, double alpha)
    : waves_(std::move(waves)), energies_(waves_->energies(alpha)) {
  factor();
}

void SkinCoarseSpace::factor() {
  factor_.emplace(energies_);
  if (!factor_->is_positive_definite())
    throw std::invalid_argument(
        "alpha is so small that double precision cannot tell the tractions apart: choose a larger "
        "one");
}

Eigen::VectorXd SkinCoarseSpace::sums(std::span<const double> x) const {
  Eigen::VectorXd all(waves_->count() + others_.cols());
  all.head(waves_->count()) = waves_->sums(x);
  if (others_.cols() > 0) all.tail(others_.cols()) = others_.transpose() * as_eigen(x);
  return all;
}

void SkinCoarseSpace::extend(
    Eigen::MatrixXd tractions,
    const std::function<void(std::span<const double>, std::span<double>)>& multiply) {
  others_ = std::move(tractions);
  const Index waves = waves_->count();
  const Index all = waves + others_.cols();
  energies_.conservativeResize(all, all);
  const auto size = static_cast<std::size_t>(others_.rows());
  std::vector<double> image(size);
  for (Index j = waves; j < all; ++j) {
    multiply({others_.col(j - waves).data(), size}, image);
    energies_.col(j) = sums(image);
    energies_.row(j) = energies_.col(j).transpose();
  }
  factor();
}

void SkinCoarseSpace::add_correction(std::span<const double> residual, std::span<double> x) const {
  Eigen::MatrixXd coefficients = sums(residual);
  factor_->solve_in_place(coefficients);
  waves_->add(coefficients.col(0).head(waves_->count()), x);
  if (others_.cols() > 0)
    Eigen::Map<Eigen::VectorXd>(x.data(), std::ssize(x)) +=
        others_ * coefficients.col(0).tail(others_.cols());
}

}  // namespace tactile_net

#include "skin/large/coarse_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "inverse/axis_waves.hpp"
#include "inverse/coordinates.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

/// Into which of the four classes of the skin's reflections a wave falls: an odd cosine turns its
/// sign, and so does a drag that is turned round.
std::size_t parity_class(std::size_t component, Index y, Index z) {
  const bool odd_y = (y % 2 == 1) != (component == 1);
  const bool odd_z = (z % 2 == 1) != (component == 2);
  return (odd_y ? 2U : 0U) + (odd_z ? 1U : 0U);
}

bool mirrors_itself(const LinearProblem& problem) {
  return std::none_of(problem.weights.begin(), problem.weights.end(),
                      [](double weight) { return weight == 0.0; });
}

}  // namespace

LowWaves::LowWaves(LargeSkinSystem& system, bool has_uniform_drags) {
  const SurfaceGrid& grid = system.problem.grid;
  const double shortest = 1.0 / std::sqrt(static_cast<double>(std::max(grid.rows, grid.columns)));
  const auto most = [&](std::size_t cells) {
    const double waves = std::ceil(shortest * static_cast<double>(cells));
    return std::clamp(static_cast<std::size_t>(waves), std::size_t{1}, cells);
  };
  along_y_ = axis_waves(grid.rows, most(grid.rows), grid.boundary_y);
  along_z_ = axis_waves(grid.columns, most(grid.columns), grid.boundary_z);

  const Eigen::VectorXd spectrum = stabiliser_spectrum(system.problem);
  std::array<std::vector<Index>, 4> classes;
  std::vector<double> of_stabiliser;
  for (std::size_t u = 0; u < system.problem.components; ++u)
    for (Index m = 0; m < along_y_.cols(); ++m)
      for (Index n = 0; n < along_z_.cols(); ++n) {
        const double y = static_cast<double>(m) / static_cast<double>(grid.rows);
        const double z = static_cast<double>(n) / static_cast<double>(grid.columns);
        if (std::hypot(y, z) >= shortest) continue;
        if (!has_uniform_drags && u > 0 && m + n == 0) continue;
        classes.at(parity_class(u, m, n)).push_back(count());
        waves_.push_back({u, m, n});
        const std::size_t row = u * grid.rows + static_cast<std::size_t>(m);
        of_stabiliser.push_back(spectrum(static_cast<Index>(row * grid.columns) + n));
      }
  stabiliser_ = as_eigen(std::span<const double>(of_stabiliser));

  of_readings_ = Eigen::MatrixXd::Zero(count(), count());
  std::vector<double> tractions(system.tractions());
  std::vector<double> readings(system.readings());
  const auto product = [&](const Eigen::VectorXd& coefficients) {
    std::fill(tractions.begin(), tractions.end(), 0.0);
    add(coefficients, tractions);
    system.weighted_readings(tractions, readings);
    system.weighted_sums(readings, tractions);
    return sums(tractions);
  };
  if (!mirrors_itself(system.problem)) {
    for (Index wave = 0; wave < count(); ++wave)
      of_readings_.col(wave) = product(Eigen::VectorXd::Unit(count(), wave));
    return;
  }
  std::size_t longest = 0;
  for (const auto& waves : classes) longest = std::max(longest, waves.size());
  for (std::size_t i = 0; i < longest; ++i) {
    Eigen::VectorXd one_of_each = Eigen::VectorXd::Zero(count());
    for (const auto& waves : classes)
      if (i < waves.size()) one_of_each(waves[i]) = 1.0;
    const Eigen::VectorXd image = product(one_of_each);
    for (const auto& waves : classes)
      if (i < waves.size())
        for (const Index wave : waves) of_readings_(wave, waves[i]) = image(wave);
  }
}

Eigen::VectorXd LowWaves::sums(std::span<const double> x) const {
  const Index rows = along_y_.rows();
  const Index columns = along_z_.rows();
  Eigen::VectorXd all(count());
  Index at = 0;
  for (std::size_t u = 0; at < count(); ++u) {
    const Eigen::Map<const RowMajor> values(x.data() + static_cast<Index>(u) * rows * columns, rows,
                                            columns);
    const Eigen::MatrixXd waves = along_y_.transpose() * (values * along_z_);
    for (; at < count() && waves_[static_cast<std::size_t>(at)].component == u; ++at) {
      const Wave& wave = waves_[static_cast<std::size_t>(at)];
      all(at) = waves(wave.y, wave.z);
    }
  }
  return all;
}

void LowWaves::add(const Eigen::VectorXd& coefficients, std::span<double> x) const {
  const Index rows = along_y_.rows();
  const Index columns = along_z_.rows();
  Index at = 0;
  for (std::size_t u = 0; at < count(); ++u) {
    Eigen::MatrixXd waves = Eigen::MatrixXd::Zero(along_y_.cols(), along_z_.cols());
    for (; at < count() && waves_[static_cast<std::size_t>(at)].component == u; ++at) {
      const Wave& wave = waves_[static_cast<std::size_t>(at)];
      waves(wave.y, wave.z) = coefficients(at);
    }
    Eigen::Map<RowMajor>(x.data() + static_cast<Index>(u) * rows * columns, rows, columns) +=
        (along_y_ * waves) * along_z_.transpose();
  }
}

Eigen::MatrixXd LowWaves::energies(double alpha) const {
  Eigen::MatrixXd all = of_readings_;
  all.diagonal() += alpha * stabiliser_;
  return all;
}

SkinCoarseSpace::SkinCoarseSpace(std::shared_ptr<const LowWaves> waves, double alpha)
    : waves_(std::move(waves)), energies_(waves_->energies(alpha)) {
  factor();
}

void SkinCoarseSpace::factor() {
  factor_.emplace(energies_);
  require_definite(factor_->is_positive_definite());
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

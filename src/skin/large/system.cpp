#include "skin/large/system.hpp"

#include <cmath>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "skin/problem_parts.hpp"

namespace tactile_net {
namespace {

SkinProblem checked_problem(const SkinArray& skin, const Material& material,
                            const SkinProblemOptions& options) {
  require_known_offsets(options.unknown_offsets, "conjugate gradients by FFT");
  SkinProblem problem = problem_without_kernel(skin, material, options);
  if (!is_lattice(skin, problem.grid))
    throw std::invalid_argument(
        "large skins are solved by FFT, for which the taxels must lie on the lattice of the grid's "
        "cells");
  return problem;
}

}  // namespace

LargeSkinSystem::LargeSkinSystem(const SkinArray& array, const Material& material,
                                 const SkinProblemOptions& options)
    : skin(array),
      problem(checked_problem(array, material, options)),
      kernels(lattice_kernels(array, material, problem.grid, problem.components)),
      products(array, problem.grid, problem.components, kernels),
      scratch_(problem.weights.size()) {}

void LargeSkinSystem::weighted_readings(std::span<const double> x, std::span<double> y) noexcept {
  products.readings(x, y);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= problem.weights[i];
}

void LargeSkinSystem::weighted_sums(std::span<const double> y, std::span<double> x) noexcept {
  for (std::size_t i = 0; i < y.size(); ++i) scratch_[i] = problem.weights[i] * y[i];
  products.sums(scratch_, x);
}

double LargeSkinSystem::size_of(double alpha, std::size_t component) const noexcept {
  return std::sqrt(alpha * problem.area) * (component == 0 ? 1.0 : problem.tangential_weight);
}

void LargeSkinSystem::apply(double alpha, std::span<const double> x, std::span<double> y) noexcept {
  weighted_readings(x, y.first(readings()));
  const SkinGrid& grid = problem.grid;
  const std::size_t n = tractions();
  const auto sizes = y.subspan(readings(), n);
  const auto slopes_y = y.subspan(readings() + n, n);
  const auto slopes_z = y.subspan(readings() + 2 * n, n);
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double size = size_of(alpha, u);
    const double along_y = size * (problem.smoothing_length / grid.spacing_y);
    const double along_z = size * (problem.smoothing_length / grid.spacing_z);
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const std::size_t at = (u * grid.rows + row) * grid.columns + column;
        sizes[at] = size * x[at];
        slopes_y[at] = row + 1 < grid.rows ? along_y * (x[at + grid.columns] - x[at]) : 0.0;
        slopes_z[at] = column + 1 < grid.columns ? along_z * (x[at + 1] - x[at]) : 0.0;
      }
  }
}

void LargeSkinSystem::apply_transposed(double alpha, std::span<const double> y,
                                       std::span<double> x) noexcept {
  weighted_sums(y.first(readings()), x);
  const SkinGrid& grid = problem.grid;
  const std::size_t n = tractions();
  const auto sizes = y.subspan(readings(), n);
  const auto slopes_y = y.subspan(readings() + n, n);
  const auto slopes_z = y.subspan(readings() + 2 * n, n);
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double size = size_of(alpha, u);
    const double along_y = size * (problem.smoothing_length / grid.spacing_y);
    const double along_z = size * (problem.smoothing_length / grid.spacing_z);
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const std::size_t at = (u * grid.rows + row) * grid.columns + column;
        const double before_y = row > 0 ? slopes_y[at - grid.columns] : 0.0;
        const double before_z = column > 0 ? slopes_z[at - 1] : 0.0;
        // Of the last row and column the slopes are 0.
        x[at] += size * sizes[at] + along_y * (before_y - slopes_y[at]) +
                 along_z * (before_z - slopes_z[at]);
      }
  }
}

}  // namespace tactile_net

#include "skin/large/system.hpp"

#include <algorithm>
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

/// Every traction once, with what weighs its size and its slopes to the next row and column.
///
/// @param visit  (at, size, along_y, along_z); a slope beyond the grid's end weighs 0
void LargeSkinSystem::walk_stabiliser(double alpha, const auto& visit) const noexcept {
  const SkinGrid& grid = problem.grid;
  for (std::size_t u = 0, at = 0; u < problem.components; ++u) {
    const double size = size_of(alpha, u);
    const double along_y = size * (problem.smoothing_length / grid.spacing_y);
    const double along_z = size * (problem.smoothing_length / grid.spacing_z);
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column, ++at)
        visit(at, size, row + 1 < grid.rows ? along_y : 0.0,
              column + 1 < grid.columns ? along_z : 0.0);
  }
}

void LargeSkinSystem::apply(double alpha, std::span<const double> x, std::span<double> y) noexcept {
  weighted_readings(x, y.first(readings()));
  const std::size_t n = tractions();
  const auto sizes = y.subspan(readings(), n);
  const auto slopes_y = y.subspan(readings() + n, n);
  const auto slopes_z = y.subspan(readings() + 2 * n, n);
  walk_stabiliser(alpha, [&](std::size_t at, double size, double along_y, double along_z) {
    sizes[at] = size * x[at];
    slopes_y[at] = along_y > 0.0 ? along_y * (x[at + problem.grid.columns] - x[at]) : 0.0;
    slopes_z[at] = along_z > 0.0 ? along_z * (x[at + 1] - x[at]) : 0.0;
  });
}

void LargeSkinSystem::apply_transposed(double alpha, std::span<const double> y,
                                       std::span<double> x) noexcept {
  weighted_sums(y.first(readings()), x);
  const std::size_t n = tractions();
  const auto sizes = y.subspan(readings(), n);
  const auto slopes_y = y.subspan(readings() + n, n);
  const auto slopes_z = y.subspan(readings() + 2 * n, n);
  walk_stabiliser(alpha, [&](std::size_t at, double size, double along_y, double along_z) {
    x[at] += size * sizes[at];
    if (along_y > 0.0) {
      x[at] -= along_y * slopes_y[at];
      x[at + problem.grid.columns] += along_y * slopes_y[at];
    }
    if (along_z > 0.0) {
      x[at] -= along_z * slopes_z[at];
      x[at + 1] += along_z * slopes_z[at];
    }
  });
}

std::shared_ptr<LargeSkinSystem> make_large_skin_system(const SkinArray& skin,
                                                        const Material& material,
                                                        const SkinProblemOptions& options) {
  return std::make_shared<LargeSkinSystem>(skin, material, options);
}

const SkinProblem& problem_of(const LargeSkinSystem& system) noexcept { return system.problem; }

std::shared_ptr<LargeSkinSystem> without_taxels(const LargeSkinSystem& system,
                                                const std::vector<std::size_t>& taxels) {
  auto rest = std::make_shared<LargeSkinSystem>(system);
  for (std::size_t i = 0; i < rest->problem.sites.size(); ++i)
    if (std::find(taxels.begin(), taxels.end(), rest->problem.sites[i].taxel) != taxels.end())
      rest->problem.weights[i] = 0.0;
  return rest;
}

std::vector<double> weighted_product(LargeSkinSystem& system, std::span<const double> tractions) {
  std::vector<double> readings(system.readings());
  system.weighted_readings(tractions, readings);
  return readings;
}

double large_skin_bytes(std::size_t cells, std::size_t components, std::size_t channels,
                        std::size_t readings) noexcept {
  constexpr double spectrum =
      3.0;  // of a kernel, over the cells: half of twice by twice, fast sizes
  constexpr double planes = 12.0;  // of complex rows and columns, of each input and output
  constexpr double kept = 30.0;    // vectors of tractions; sums and their images are most of them
  constexpr double slow = 15.0;    // tractions of the coarse space that are no waves, at most
  constexpr double tiles = 2e8;    // kinds of tiles, and nodes of the probes
  const auto pairs = static_cast<double>(components * channels);
  const auto most = static_cast<double>(std::max(components, channels));
  const auto size = static_cast<double>(cells);
  const double numbers =
      size * (pairs * (spectrum + 1.0) + most * planes + static_cast<double>(components) * slow) +
      kept * (4.0 * size * static_cast<double>(components) + static_cast<double>(readings));
  return sizeof(double) * numbers + tiles;
}

}  // namespace tactile_net

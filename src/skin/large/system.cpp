#include "skin/large/system.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "skin/problem_parts.hpp"

namespace tactile_net {
namespace {

LinearProblem checked_problem(const SkinArray& skin, const Material& material,
                              const SkinProblemOptions& options) {
  require_known_offsets(options.unknown_offsets, "conjugate gradients by FFT");
  LinearProblem problem = problem_without_kernel(skin, material, options);
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
  return std::sqrt(alpha * problem.measure) * (component == 0 ? 1.0 : problem.tangential_weight);
}

/// Every traction once, with what weighs its size and its slopes to the next row and column.
///
/// @param visit  (at, size, along_y, along_z); a slope beyond the grid's end weighs 0
void LargeSkinSystem::walk_stabiliser(double alpha, const auto& visit) const noexcept {
  const SurfaceGrid& grid = problem.grid;
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

const LinearProblem& problem_of(const LargeSkinSystem& system) noexcept { return system.problem; }

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

std::vector<bool> dead_taxels(const LinearProblem& problem) {
  std::vector<bool> dead(problem.taxels);
  for (std::size_t i = 0; i < problem.sites.size(); ++i)
    if (problem.weights[i] == 0.0) dead[problem.sites[i].taxel] = true;
  return dead;
}

void require_definite(bool is_positive_definite) {
  if (!is_positive_definite)
    throw std::invalid_argument(
        "alpha is so small that double precision cannot tell the tractions apart: choose a larger "
        "one");
}

double large_skin_bytes(const LargeSkinSize& size) noexcept {
  constexpr double program = 30e6;    // with what is written of an answer
  constexpr double of_pairs = 3.4e6;  // kinds of tiles, and the smaller skin of the bands
  constexpr double spectrum = 2.3;    // of a kernel beside itself, over the cells
  constexpr double planes = 2.4;      // rows of an input or output, complex
  constexpr double vectors = 109.0;   // of tractions and readings: sums and images most of them
  constexpr double slow = 15.0;       // of the coarse space that are no waves, at most
  constexpr double of_constraints = 16.0;  // vectors of tractions
  constexpr double of_faces = 8e6;
  constexpr double of_a_tile = 256.0;  // tractions of a component
  constexpr double in_reach = 576.0;   // taxels of a tile
  constexpr double tiles = 9.0;        // which a taxel is in reach of
  const auto components = static_cast<double>(size.components);
  const auto channels = static_cast<double>(size.channels);
  const double pairs = components * channels;
  const double each = spectrum * pairs + planes * (components + channels) +
                      (vectors + slow) * components +
                      (size.constrained ? of_constraints * components : 0.0);
  // Of a tile's dead readings its tractions, and each of the others.
  const double dead = channels * static_cast<double>(size.dead_taxels);
  const double most_together = std::min(dead, in_reach * channels);
  const double corrections = tiles * dead * (of_a_tile * components + most_together);
  return program + (size.constrained ? of_faces : 0.0) +
         of_pairs * components * std::max(components, channels) +
         sizeof(double) * (each * static_cast<double>(size.cells) + corrections);
}

}  // namespace tactile_net

/// @file
/// What the tests of large skins share: a thin pad, readings of a contact, what matrices say, and
/// the laws that every one of them keeps.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "src/skin/large/preconditioner.hpp"
#include "src/skin/large/system.hpp"
#include "tactile_net/inverse/stabiliser.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

namespace tactile_net {

inline const Material thin{
    .youngs_modulus = 2e5, .poisson_ratio = 0.45, .layer = Layer{4e-3, Base::bonded}};

inline SkinProblemOptions with_dead(std::vector<std::size_t> dead, SkinGridOptions grid = {}) {
  return {.dead_taxels = std::move(dead), .grid = grid};
}

/// One contact and 1 % noise, by the matrix.
inline std::vector<double> readings_of(const LinearProblem& problem, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> tractions(problem.kernel.columns);
  const SurfaceGrid& grid = problem.grid;
  for (std::size_t u = 0; u < problem.components; ++u)
    for (std::size_t i = 0; i < grid.count(); ++i) {
      const double y = (grid.y(i / grid.columns) - 1e-3) / 3e-3;
      const double z = grid.z(i % grid.columns) / 3e-3;
      tractions[u * grid.count() + i] =
          std::sqrt(std::max(1.0 - y * y - z * z, 0.0)) * (u == 0   ? 1e4
                                                           : u == 1 ? 3e3
                                                                    : -2e3);
    }
  std::vector<double> readings = product(problem.kernel, tractions);
  add_noise(readings, 0.01, random);
  return readings;
}

/// K' y.
inline std::vector<double> transposed_product(const Matrix& matrix, std::span<const double> y) {
  std::vector<double> x(matrix.columns);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < matrix.columns; ++j) x[j] += matrix(i, j) * y[i];
  return x;
}

/// |P x - b| / |b| by the matrices.
inline double normal_residual(const LinearProblem& problem, double alpha, std::span<const double> x,
                              std::span<const double> b) {
  std::vector<double> image = transposed_product(problem.kernel, product(problem.kernel, x));
  const std::vector<double> smooth = product(stabiliser_matrix(problem, alpha), x);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] += smooth[i];
  return distance(image, b) / norm(b);
}

/// The square of the largest singular value.
inline double size_of(const LinearProblem& problem) {
  return std::pow(TikhonovFamily(problem).singular_values().front(), 2);
}

inline double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// P x.
inline std::vector<double> normal_product(LargeSkinSystem& system, double alpha,
                                          std::span<const double> x) {
  std::vector<double> image(system.rows());
  std::vector<double> result(x.size());
  system.apply(alpha, x, image);
  system.apply_transposed(alpha, image, result);
  return result;
}

/// Conjugate gradients reach the minimiser by the decomposition, and say how far off they are.
inline void check_reaches_minimiser(const SkinArray& skin, const Material& material,
                                    std::vector<std::size_t> dead) {
  const SkinProblemOptions options = with_dead(std::move(dead));
  const LinearProblem dense = make_problem(skin, material, options);
  const TikhonovFamily family(dense);
  const double size = std::pow(family.singular_values().front(), 2);
  const std::vector<double> readings = readings_of(dense, 1);
  LargeSkinTikhonov solver(skin, material, options, size);
  for (const double share : {1e-2, 1e-5}) {
    const double alpha = share * size;
    solver.use_alpha(alpha);
    const auto expected = family.solve(family.analyse(readings), alpha);
    std::vector<double> found(expected.size());
    REQUIRE(solver.solve(readings, found) == FrameStatus::ok);
    CAPTURE(share, solver.convergence().steps);
    CHECK(solver.convergence().converged);
    const double error = distance(found, expected) / norm(expected);
    CHECK(error < 1e-6);
    CHECK(error <= solver.convergence().bound + 1e-9);

    const auto right = normal_right_side(dense, readings);
    CHECK(distance(solver.normal_right_side(readings), right) < 1e-12 * norm(right));
    const auto x = solver.solve_normal(right);
    CHECK(solver.convergence().steps <= 36);
    CHECK(normal_residual(dense, alpha, x, right) < 2e-8);
  }
}

/// Steps to 1e-8 for every alpha.
inline void check_steps(const SkinArray& skin, const Material& material,
                        const SkinProblemOptions& options = {}) {
  const auto system = make_large_skin_system(skin, material, options);
  const double even = std::pow(uniform_readings(*system).pressure, 2);
  LargeSkinTikhonov solver(system, even);
  const std::vector<double> right = solver.normal_right_side(random_numbers(system->readings(), 4));
  for (const double share : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const double alpha = share * even;
    solver.use_alpha(alpha);
    const std::vector<double> x = solver.solve_normal(right);
    CAPTURE(skin.rows, options.dead_taxels.size(), share, solver.convergence().steps);
    CHECK(solver.convergence().converged);
    CHECK(solver.convergence().steps <= (share < 1e-7 ? 120 : 36));
    CHECK(distance(normal_product(*system, alpha, x), right) < 2e-8 * norm(right));
  }
}

}  // namespace tactile_net

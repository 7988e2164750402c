/// @file
/// Frames, and the unit of a plan's accuracy, that the tests of plans share.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/inverse/problems.hpp"

namespace tactile_net {

/// |f| + |M W^-1| |W (g - K f)|, the unit of a plan's accuracy, with the largest column of M W^-1
/// for its norm, which is smaller: a stricter check.
inline double unit_of_error(const LinearProblem& problem, const Reconstruction& inverse,
                            std::span<const double> g, std::span<const double> f) {
  double norm = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (problem.weights[i] > 0.0)
      norm = std::max(norm, l2_norm(inverse.transposed().row(i)) / problem.weights[i]);
  std::vector<double> residual(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) {
    residual[i] = problem.weights[i] * g[i];
    for (std::size_t j = 0; j < f.size(); ++j) residual[i] -= problem.kernel(i, j) * f[j];
  }
  return l2_norm(f) + norm * l2_norm(residual);
}

inline std::vector<double> difference(std::vector<double> a, std::span<const double> b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

/// Readings of random tractions, some of them at the very edge of the array.
inline std::vector<double> contact_readings(const LinearProblem& problem, unsigned seed) {
  const std::size_t n = problem.grid.count();
  std::vector<double> f(problem.kernel.columns, 0.0);
  const std::vector<double> where = random_values(6, seed);
  for (std::size_t k = 0; k < 3; ++k) {
    const double centre = 0.5 * static_cast<double>(n) * (1.0 + (k == 0 ? 0.99 : where[k]));
    const double width = 2.0 + 0.05 * static_cast<double>(n) * (1.0 + where[k + 3]);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double z = (static_cast<double>(i % n) - centre) / width;
      if (std::abs(z) < 1.0) f[i] += std::sqrt(1.0 - z * z) * (i < n ? 1.0 : 0.3);
    }
  }
  std::vector<double> g(problem.kernel.rows, 0.0);
  for (std::size_t i = 0; i < g.size(); ++i)
    if (problem.weights[i] > 0.0)
      for (std::size_t j = 0; j < f.size(); ++j)
        g[i] += problem.kernel(i, j) * f[j] / problem.weights[i];
  return g;
}

}  // namespace tactile_net

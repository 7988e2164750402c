#include "tactile_net/skin/stabiliser.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "skin/sparse_stabiliser.hpp"

namespace tactile_net {
namespace {

/// Calls `add` with (i, j, value) of alpha L'L, again and again for the same entry.
void visit_stabiliser(const SkinProblem& problem, double alpha, const auto& add) {
  const SkinGrid& grid = problem.grid;
  const double y = problem.smoothing_length / grid.spacing_y;
  const double z = problem.smoothing_length / grid.spacing_z;
  /// `weight` times the squared difference of two cells.
  const auto add_difference = [&](std::size_t a, std::size_t b, double weight) {
    add(a, a, weight);
    add(b, b, weight);
    add(a, b, -weight);
    add(b, a, -weight);
  };
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double weight = u == 0 ? 1.0 : problem.tangential_weight;
    const double scale = alpha * problem.area * weight * weight;
    const auto at = [&](std::size_t row, std::size_t column) {
      return u * grid.count() + row * grid.columns + column;
    };
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const std::size_t cell = at(row, column);
        add(cell, cell, scale);
        if (row + 1 < grid.rows) add_difference(cell, at(row + 1, column), scale * y * y);
        if (column + 1 < grid.columns) add_difference(cell, at(row, column + 1), scale * z * z);
      }
  }
}

}  // namespace

Matrix stabiliser_matrix(const SkinProblem& problem, double alpha) {
  if (!(alpha > 0.0 && std::isfinite(alpha)))
    throw std::invalid_argument("alpha must be > 0 and finite");
  const std::size_t size = problem.components * problem.grid.count();
  Matrix matrix{size, size, std::vector<double>(size * size)};
  visit_stabiliser(problem, alpha,
                   [&](std::size_t i, std::size_t j, double value) { matrix(i, j) += value; });
  return matrix;
}

Eigen::SparseMatrix<double> sparse_stabiliser(const SkinProblem& problem) {
  const auto size = static_cast<Eigen::Index>(problem.components * problem.grid.count());
  std::vector<Eigen::Triplet<double>> entries;
  visit_stabiliser(problem, 1.0, [&](std::size_t i, std::size_t j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  });
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace tactile_net

#include "tactile_net/skin/stabiliser.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace tactile_net {
namespace {

/// Adds `weight` times the squared difference of two cells.
void add_difference(Matrix& matrix, std::size_t a, std::size_t b, double weight) {
  matrix(a, a) += weight;
  matrix(b, b) += weight;
  matrix(a, b) -= weight;
  matrix(b, a) -= weight;
}

}  // namespace

Matrix stabiliser_matrix(const SkinProblem& problem, double alpha) {
  if (!(alpha > 0.0 && std::isfinite(alpha)))
    throw std::invalid_argument("alpha must be > 0 and finite");
  const SkinGrid& grid = problem.grid;
  const std::size_t size = problem.components * grid.count();
  Matrix matrix{size, size, std::vector<double>(size * size)};
  const double y = problem.smoothing_length / grid.spacing_y;
  const double z = problem.smoothing_length / grid.spacing_z;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double weight = u == 0 ? 1.0 : problem.tangential_weight;
    const double scale = alpha * problem.area * weight * weight;
    const auto at = [&](std::size_t row, std::size_t column) {
      return u * grid.count() + row * grid.columns + column;
    };
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const std::size_t cell = at(row, column);
        matrix(cell, cell) += scale;
        if (row + 1 < grid.rows) add_difference(matrix, cell, at(row + 1, column), scale * y * y);
        if (column + 1 < grid.columns)
          add_difference(matrix, cell, at(row, column + 1), scale * z * z);
      }
  }
  return matrix;
}

}  // namespace tactile_net

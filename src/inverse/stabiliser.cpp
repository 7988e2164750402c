#include "tactile_net/inverse/stabiliser.hpp"

#include <cmath>
#include <vector>

#include "inverse/axis_waves.hpp"
#include "inverse/checks.hpp"
#include "inverse/sparse_stabiliser.hpp"
#include "inverse/stabiliser_weight.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// Calls `add` with (i, j, value) of alpha L'L, again and again for the same entry.
void visit_stabiliser(const LinearProblem& problem, double alpha, const auto& add) {
  const SurfaceGrid& grid = problem.grid;
  const double y = problem.smoothing_length / grid.spacing_y;
  const double z = problem.smoothing_length / grid.spacing_z;
  /// `weight` times the squared difference of two cells.
  const auto add_difference = [&](std::size_t a, std::size_t b, double weight) {
    add(a, a, weight);
    add(b, b, weight);
    add(a, b, -weight);
    add(b, a, -weight);
  };
  const bool ends_y = grid.boundary_y == Boundary::zero_beyond;
  const bool ends_z = grid.boundary_z == Boundary::zero_beyond;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double weight = stabiliser_weight(u, problem.tangential_weight);
    const double scale = alpha * problem.measure * weight * weight;
    const auto at = [&](std::size_t row, std::size_t column) {
      return u * grid.count() + row * grid.columns + column;
    };
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const std::size_t cell = at(row, column);
        add(cell, cell, scale);
        if (row + 1 < grid.rows) add_difference(cell, at(row + 1, column), scale * y * y);
        if (column + 1 < grid.columns) add_difference(cell, at(row, column + 1), scale * z * z);
        if (ends_y && row == 0) add(cell, cell, scale * y * y);
        if (ends_y && row + 1 == grid.rows) add(cell, cell, scale * y * y);
        if (ends_z && column == 0) add(cell, cell, scale * z * z);
        if (ends_z && column + 1 == grid.columns) add(cell, cell, scale * z * z);
      }
  }
}

}  // namespace

Matrix stabiliser_matrix(const LinearProblem& problem, double alpha) {
  check_alpha(alpha);
  const std::size_t size = problem.components * problem.grid.count();
  Matrix matrix{size, size, std::vector<double>(size * size)};
  visit_stabiliser(problem, alpha,
                   [&](std::size_t i, std::size_t j, double value) { matrix(i, j) += value; });
  return matrix;
}

Eigen::SparseMatrix<double> sparse_stabiliser(const LinearProblem& problem) {
  const auto size = static_cast<Eigen::Index>(problem.components * problem.grid.count());
  std::vector<Eigen::Triplet<double>> entries;
  visit_stabiliser(problem, 1.0, [&](std::size_t i, std::size_t j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  });
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double prior_deviation(const LinearProblem& problem, std::span<const double> weights,
                       double alpha) {
  check_alpha(alpha);
  const SurfaceGrid& grid = problem.grid;
  check_weights(weights, problem.components * grid.count());
  const Eigen::MatrixXd down = axis_waves(grid.rows, grid.rows, grid.boundary_y);
  const Eigen::MatrixXd across = axis_waves(grid.columns, grid.columns, grid.boundary_z);
  const double y = std::pow(problem.smoothing_length / grid.spacing_y, 2);
  const double z = std::pow(problem.smoothing_length / grid.spacing_z, 2);
  double sum = 0.0;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const Eigen::Map<const RowMajor> cells(weights.data() + u * grid.count(),
                                           static_cast<Eigen::Index>(grid.rows),
                                           static_cast<Eigen::Index>(grid.columns));
    const Eigen::MatrixXd waves = down.transpose() * cells * across;
    const double weight = stabiliser_weight(u, problem.tangential_weight);
    for (std::size_t m = 0; m < grid.rows; ++m)
      for (std::size_t n = 0; n < grid.columns; ++n) {
        const double size =
            waves(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) / weight;
        sum += size * size /
               (1.0 + y * roughness(m, grid.rows, grid.boundary_y) +
                z * roughness(n, grid.columns, grid.boundary_z));
      }
  }
  return std::sqrt(sum / (alpha * problem.measure));
}

}  // namespace tactile_net

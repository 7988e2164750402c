#include "tactile_net/skin/stabiliser.hpp"

#include <vector>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/cosine_waves.hpp"
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
  check_alpha(alpha);
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

double prior_deviation(const SkinProblem& problem, std::span<const double> weights, double alpha) {
  check_alpha(alpha);
  const SkinGrid& grid = problem.grid;
  check_weights(weights, problem.components * grid.count());
  const Eigen::MatrixXd down = cosine_waves(grid.rows, grid.rows);
  const Eigen::MatrixXd across = cosine_waves(grid.columns, grid.columns);
  const double y = std::pow(problem.smoothing_length / grid.spacing_y, 2);
  const double z = std::pow(problem.smoothing_length / grid.spacing_z, 2);
  double sum = 0.0;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const Eigen::Map<const RowMajor> cells(weights.data() + u * grid.count(),
                                           static_cast<Eigen::Index>(grid.rows),
                                           static_cast<Eigen::Index>(grid.columns));
    const Eigen::MatrixXd waves = down.transpose() * cells * across;
    const double weight = u == 0 ? 1.0 : problem.tangential_weight;
    for (std::size_t m = 0; m < grid.rows; ++m)
      for (std::size_t n = 0; n < grid.columns; ++n) {
        const double size =
            waves(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) / weight;
        sum += size * size / (1.0 + y * roughness(m, grid.rows) + z * roughness(n, grid.columns));
      }
  }
  return std::sqrt(sum / (alpha * problem.area));
}

}  // namespace tactile_net

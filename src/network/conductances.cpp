#include "tactile_net/network/conductances.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/finite.hpp"

namespace tactile_net {
namespace {

void check_square(const Matrix& matrix) {
  if (matrix.rows != matrix.columns || matrix.rows == 0 ||
      matrix.values.size() != matrix.rows * matrix.columns)
    throw std::invalid_argument("P must be square and not empty");
  if (!all_finite(matrix.values)) throw std::invalid_argument("P must be finite");
}

/// Sum with a running compensation (Neumaier): row sums of P cancel to a fraction of its entries.
double compensated_sum(std::span<const double> values) noexcept {
  double sum = 0.0;
  double lost = 0.0;
  for (const double value : values) {
    const double next = sum + value;
    lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  return sum + lost;
}

}  // namespace

ConductanceNetwork conductances(const Matrix& matrix) {
  check_square(matrix);
  const std::size_t n = matrix.rows;
  const double largest = as_eigen(matrix).cwiseAbs().maxCoeff();

  ConductanceNetwork network{.nodes = n, .branches = {}, .ground = std::vector<double>(n)};
  network.branches.reserve(n * (n - 1) / 2);
  for (std::size_t i = 0; i < n; ++i) {
    network.ground[i] = compensated_sum(matrix.row(i));
    for (std::size_t j = i + 1; j < n; ++j) {
      if (!(std::abs(matrix(i, j) - matrix(j, i)) <= 1e-12 * largest))
        throw std::invalid_argument("P must be symmetric: entries (" + std::to_string(i) + ", " +
                                    std::to_string(j) + ") differ");
      if (matrix(i, j) != 0.0) network.branches.push_back({i, j, -matrix(i, j)});
    }
  }
  return network;
}

double largest_row_sum(const Matrix& matrix) {
  double largest = 0.0;
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    double sum = 0.0;
    for (const double value : matrix.row(i)) sum += std::abs(value);
    largest = std::max(largest, sum);
  }
  return largest;
}

EigenvalueRange eigenvalue_range(const Matrix& matrix) {
  check_square(matrix);
  const Eigen::VectorXd ascending = symmetric_eigenvalues(as_eigen(matrix));
  return {ascending(0), ascending(ascending.size() - 1)};
}

double smallest_eigenvalue(const Matrix& matrix) { return eigenvalue_range(matrix).smallest; }

std::vector<double> solve_symmetric(const Matrix& matrix, const std::vector<double>& right_side) {
  check_square(matrix);
  if (right_side.size() != matrix.rows)
    throw std::invalid_argument("the right side must have one value per row of P");
  const Eigen::VectorXd b = as_eigen(std::span(right_side));
  const Eigen::VectorXd x = solve_definite(as_eigen(matrix), b);
  return {x.begin(), x.end()};
}

}  // namespace tactile_net

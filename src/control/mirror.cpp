#include "control/mirror.hpp"

#include <cmath>

namespace tactile_net {
namespace {

/// Calls `pair(column, i, j, sign)` for every pair i < j of a class, sign +1 for its sum, and
/// `centre(column, i)` for the centre of an odd block.
Eigen::Index for_each(const Signs& signs, Eigen::Index size, int which, const auto& pair,
                      const auto& centre) {
  const Eigen::Index n = size / std::ssize(signs);
  Eigen::Index column = 0;
  for (Eigen::Index block = 0; block < std::ssize(signs); ++block) {
    const bool sums = (signs[static_cast<std::size_t>(block)] > 0) == (which == 0);
    const Eigen::Index first = block * n;
    for (Eigen::Index i = 0; i < n / 2; ++i)
      pair(column++, first + i, first + n - 1 - i, sums ? 1.0 : -1.0);
    if (sums && n % 2 != 0) centre(column++, first + n / 2);
  }
  return column;
}

Eigen::Index class_size(const Signs& signs, Eigen::Index size, int which) {
  return for_each(
      signs, size, which, [](auto...) {}, [](auto...) {});
}

}  // namespace

Eigen::MatrixXd class_basis(const Signs& signs, Eigen::Index size, int which) {
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(size, class_size(signs, size, which));
  for_each(
      signs, size, which,
      [&](Eigen::Index column, Eigen::Index i, Eigen::Index j, double sign) {
        basis(i, column) = std::sqrt(0.5);
        basis(j, column) = sign * std::sqrt(0.5);
      },
      [&](Eigen::Index column, Eigen::Index i) { basis(i, column) = 1.0; });
  return basis;
}

Eigen::VectorXd class_scale(const Signs& signs, Eigen::Index size, int which) {
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(class_size(signs, size, which), std::sqrt(0.5));
  for_each(
      signs, size, which, [](auto...) {},
      [&](Eigen::Index column, Eigen::Index) { scale(column) = 1.0; });
  return scale;
}

Eigen::MatrixXd mirrored(const Eigen::MatrixXd& a, const Signs& rows, const Signs& columns) {
  Eigen::MatrixXd result(a.rows(), a.cols());
  const Eigen::Index m = a.rows() / std::ssize(rows);
  const Eigen::Index n = a.cols() / std::ssize(columns);
  for (Eigen::Index i = 0; i < std::ssize(rows); ++i)
    for (Eigen::Index j = 0; j < std::ssize(columns); ++j)
      result.block(i * m, j * n, m, n) =
          (rows[static_cast<std::size_t>(i)] * columns[static_cast<std::size_t>(j)]) *
          a.block(i * m, j * n, m, n).reverse();
  return result;
}

}  // namespace tactile_net

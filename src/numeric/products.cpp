#include "numeric/products.hpp"

namespace tactile_net {
namespace {

template <int order>
auto mapped(const StridedMatrix& a) {
  using Doubles = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, order>;
  return Eigen::Map<const Doubles, 0, Eigen::OuterStride<>>(a.data, a.rows, a.columns,
                                                            Eigen::OuterStride<>(a.stride));
}

/// Calls `use` with Eigen's view of the matrix.
void with_view(const StridedMatrix& a, const auto& use) {
  if (a.row_major)
    use(mapped<Eigen::RowMajor>(a));
  else
    use(mapped<Eigen::ColMajor>(a));
}

}  // namespace

Eigen::MatrixXd product(const StridedMatrix& a, const StridedMatrix& b) {
  eigen_assert(a.columns == b.rows);
  Eigen::MatrixXd c(a.rows, b.columns);
  with_view(a, [&](const auto& left) {
    with_view(b, [&](const auto& right) { c.noalias() = left.operator*(right); });
  });
  return c;
}

Eigen::VectorXd product(const StridedMatrix& a, const StridedVector& x) {
  eigen_assert(a.columns == x.size);
  const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>> right(
      x.data, x.size, Eigen::InnerStride<>(x.stride));
  Eigen::VectorXd y(a.rows);
  with_view(a, [&](const auto& left) { y.noalias() = left.operator*(right); });
  return y;
}

}  // namespace tactile_net

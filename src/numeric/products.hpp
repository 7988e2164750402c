/// @file
/// Products of matrices, compiled once: Eigen makes each of them again for every pair of types that
/// a file multiplies. Private.
///
/// Within the library `a * b` of two matrices, a matrix and a column, or a row and a matrix, all of
/// doubles and of sizes that are known at run time alone, is a call of the functions below. It is
/// no expression, but has its value at once, in memory of its own. Eigen itself, which can
/// write into memory that is there, is asked by name: `y.noalias() = a.operator*(x)`.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <type_traits>

namespace tactile_net {

/// Where the numbers of a matrix lie: rows or columns of neighbours, `stride` apart.
struct StridedMatrix {
  const double* data = nullptr;
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  Eigen::Index stride = 0;
  bool row_major = false;

  [[nodiscard]] StridedMatrix transposed() const noexcept {
    return {data, columns, rows, stride, !row_major};
  }
};

struct StridedVector {
  const double* data = nullptr;
  Eigen::Index size = 0;
  Eigen::Index stride = 1;
};

/// A B, and A x.
[[nodiscard]] Eigen::MatrixXd product(const StridedMatrix& a, const StridedMatrix& b);
[[nodiscard]] Eigen::VectorXd product(const StridedMatrix& a, const StridedVector& x);

template <class T>
concept DenseDoubles =
    std::derived_from<T, Eigen::MatrixBase<T>> && std::same_as<typename T::Scalar, double>;
template <class T>
concept DenseMatrix = DenseDoubles<T> && T::RowsAtCompileTime ==
                      Eigen::Dynamic&& T::ColsAtCompileTime == Eigen::Dynamic;
template <class T>
concept DenseColumn =
    DenseDoubles<T> && T::RowsAtCompileTime == Eigen::Dynamic&& T::ColsAtCompileTime == 1;
template <class T>
concept DenseRow =
    DenseDoubles<T> && T::RowsAtCompileTime == 1 && T::ColsAtCompileTime == Eigen::Dynamic;

/// Whether the numbers lie in memory, those of a matrix beside each other.
template <class T>
inline constexpr bool is_stored = (T::Flags & Eigen::DirectAccessBit) != 0 &&
                                  (!DenseMatrix<T> || int{T::InnerStrideAtCompileTime} == 1);

/// What the numbers of `a` are stored in: itself, or memory that they are written to.
template <DenseDoubles T>
[[nodiscard]] decltype(auto) stored(const T& a) {
  if constexpr (is_stored<T>)
    return a;
  else
    return typename T::PlainObject(a);
}

template <DenseMatrix T>
[[nodiscard]] StridedMatrix strided(const T& a) {
  return {a.data(), a.rows(), a.cols(), a.outerStride(), bool(T::IsRowMajor)};
}
template <DenseDoubles T>
[[nodiscard]] StridedVector strided(const T& a) {
  return {a.data(), a.size(), a.innerStride()};
}

template <DenseMatrix A, DenseMatrix B>
[[nodiscard]] Eigen::MatrixXd operator*(const A& a, const B& b) {
  return product(strided(stored(a)), strided(stored(b)));
}

template <DenseMatrix A, DenseColumn B>
[[nodiscard]] Eigen::VectorXd operator*(const A& a, const B& x) {
  return product(strided(stored(a)), strided(stored(x)));
}

template <DenseRow A, DenseMatrix B>
[[nodiscard]] Eigen::RowVectorXd operator*(const A& x, const B& b) {
  return product(strided(stored(b)).transposed(), strided(stored(x))).transpose();
}

}  // namespace tactile_net

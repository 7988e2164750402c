#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/bidiagonalisation.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {

namespace {

constexpr int thin = Eigen::ComputeThinU | Eigen::ComputeThinV;
#if EIGEN_MAJOR_VERSION < 5  // 3.4, whose type has no place for the options
using DividedSvd = Eigen::BDCSVD<Eigen::MatrixXd>;
using JacobiSvd = Eigen::JacobiSVD<Eigen::MatrixXd>;
#else
using DividedSvd = Eigen::BDCSVD<Eigen::MatrixXd, thin>;
using JacobiSvd = Eigen::JacobiSVD<Eigen::MatrixXd, thin>;
#endif

template <class Solver>
Svd decomposed(const Eigen::MatrixXd& a) {
#if EIGEN_MAJOR_VERSION < 5
  const Solver svd(a, thin);
#else
  const Solver svd(a);
#endif
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

/// Whether A V = U S and V'V = 1, to a hundred times the rounding of a decomposition of this size.
bool holds(const Svd& svd, const Eigen::MatrixXd& a) {
  const double limit = 100.0 * std::numeric_limits<double>::epsilon() *
                       static_cast<double>(std::max(a.rows(), a.cols()));
  const Eigen::MatrixXd left = a * svd.v - svd.u * svd.values.asDiagonal();
  const Eigen::MatrixXd overlap = svd.v.transpose() * svd.v;
  return left.cwiseAbs().maxCoeff() <= limit * svd.values(0) && overlap.isIdentity(limit);
}

/// Reflections and rotations square entries: a power of two scales them without a rounding.
double power_of_two(const Eigen::MatrixXd& a) {
  int exponent = 0;
  std::frexp(a.cwiseAbs().maxCoeff(), &exponent);
  return std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
}

}  // namespace

/// Eigen's divide and conquer reports success with vectors, and values, that are wrong by as much
/// as the matrix is large where many singular values are equal (3.4.0: two clusters of fifteen).
/// What it finds is checked; rotations are slower, and right.
Svd singular_value_decomposition(const Eigen::MatrixXd& a) {
  Svd svd = decomposed<DividedSvd>(a);
  if (a.size() == 0 || !a.allFinite() || holds(svd, a)) return svd;
  return decomposed<JacobiSvd>(a);
}

Svd long_singular_value_decomposition(const Eigen::MatrixXd& a) {
  if (a.rows() < a.cols()) {
    Svd svd = long_singular_value_decomposition(Eigen::MatrixXd(a.transpose()));
    std::swap(svd.u, svd.v);
    return svd;
  }
  const double size = power_of_two(a);
  const HouseholderQr qr(a / size);
  Svd svd = singular_value_decomposition(qr.triangle());
  svd.values *= size;
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  u.topRows(a.cols()) = svd.u;
  svd.u = qr.rotate_back(u);
  return svd;
}

struct Bidiagonalisation::Factors : Eigen::internal::UpperBidiagonalization<Eigen::MatrixXd> {
  using UpperBidiagonalization::UpperBidiagonalization;
};

Bidiagonalisation::Bidiagonalisation(const Eigen::MatrixXd& a)
    : factors_(std::make_unique<const Factors>(a)) {
  const Eigen::MatrixXd b = factors_->bidiagonal().toDenseMatrix();
  diagonal_ = b.diagonal();
  above_ = b.diagonal<1>();
}
Bidiagonalisation::Bidiagonalisation(Bidiagonalisation&&) noexcept = default;
Bidiagonalisation& Bidiagonalisation::operator=(Bidiagonalisation&&) noexcept = default;
Bidiagonalisation::~Bidiagonalisation() = default;

Eigen::MatrixXd Bidiagonalisation::rotate(const Eigen::MatrixXd& x) const {
  return factors_->householderU().adjoint() * x;
}

Eigen::MatrixXd Bidiagonalisation::right_vectors() const {
  const Eigen::Index n = diagonal_.size();
  // Eigen asks for one that may change, and changes nothing.
  return Factors(*factors_).householderV() * Eigen::MatrixXd::Identity(n, n);
}

namespace {

/// Of [0 B'; B 0], in the order that Golub and Kahan found, what stands beside the diagonal of
/// zeros: b11, b12, b22, b23 ...
Eigen::VectorXd beside_zeros(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& above) {
  const Eigen::Index n = diagonal.size();
  Eigen::VectorXd beside(2 * n - 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    beside(2 * i) = diagonal(i);
    if (i + 1 < n) beside(2 * i + 1) = above(i);
  }
  return beside;
}

}  // namespace

double largest_singular_value(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& above) {
  return largest_tridiagonal_eigenvalue(Eigen::VectorXd::Zero(2 * diagonal.size()),
                                        beside_zeros(diagonal, above));
}

/// Of the bidiagonal matrix B of A: the eigenvalues of [0 B'; B 0], a tridiagonal matrix in the
/// order that Golub and Kahan found, are the singular values and their negatives. No divide and
/// conquer, see above.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) {
  if (a.rows() < a.cols()) return singular_values(Eigen::MatrixXd(a.transpose()));
  const Eigen::Index n = a.cols();
  if (n == 0) return {};
  if (!a.allFinite()) return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  const double size = power_of_two(a);
  const Eigen::internal::UpperBidiagonalization<Eigen::MatrixXd> bidiagonal(a / size);
  const Eigen::MatrixXd b = bidiagonal.bidiagonal().toDenseMatrix();
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(2 * n),
                                beside_zeros(b.diagonal(), b.diagonal<1>()),
                                Eigen::EigenvaluesOnly);
  return size * solver.eigenvalues().tail(n).reverse().cwiseMax(0.0);
}

}  // namespace tactile_net

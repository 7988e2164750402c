#include "numeric/lyapunov.hpp"

#include <Eigen/Eigenvalues>
#include <complex>

#include "numeric/triangular_logarithm.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

/// One product of one pair of types: Eigen would make each of its own.
Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) { return a * b; }

}  // namespace

Lyapunov::Lyapunov(const Eigen::MatrixXd& a) {
  const Eigen::ComplexSchur<Eigen::MatrixXd> schur(a);
  u_ = schur.matrixU();
  t_ = schur.matrixT();
}

double Lyapunov::largest_real_part() const { return t_.diagonal().real().maxCoeff(); }

Eigen::MatrixXd Lyapunov::solve(const Eigen::MatrixXd& q) const {
  // T Y + Y T* = F, column by column from the last.
  const Eigen::MatrixXcd f = -product(product(u_.adjoint(), q.cast<Complex>()), u_);
  Eigen::MatrixXcd y = Eigen::MatrixXcd::Zero(t_.rows(), t_.cols());
  for (Eigen::Index j = t_.rows() - 1; j >= 0; --j) {
    const Eigen::Index behind = t_.rows() - 1 - j;
    Eigen::VectorXcd right = f.col(j) - y.rightCols(behind) * t_.row(j).tail(behind).adjoint();
    Eigen::MatrixXcd shifted = t_;
    shifted.diagonal().array() += std::conj(t_(j, j));
    shifted.triangularView<Eigen::Upper>().solveInPlace(right);
    y.col(j) = right;
  }
  const Eigen::MatrixXd x = product(product(u_, y), u_.adjoint()).real();
  return 0.5 * (x + x.transpose());
}

Eigen::MatrixXd Lyapunov::solve_flicker(const Eigen::MatrixXd& q, double lowest) const {
  const Complex turned(0.0, -1.0 / lowest);
  const Eigen::Index n = t_.rows();
  const Eigen::MatrixXcd shifted = Eigen::MatrixXcd::Identity(n, n) + turned * t_;
  const Eigen::MatrixXd logarithm =
      product(product(u_, triangular_logarithm(shifted)), u_.adjoint()).real();
  Eigen::MatrixXcd right = product(u_.adjoint(), (logarithm * q).cast<Complex>());
  t_.triangularView<Eigen::Upper>().solveInPlace(right);
  const Eigen::MatrixXd together = -product(u_, right).real();
  return solve(2.0 * (together + together.transpose()));
}

}  // namespace tactile_net

#include "numeric/lyapunov.hpp"

#include <Eigen/Eigenvalues>
#include <complex>

namespace tactile_net {

Lyapunov::Lyapunov(const Eigen::MatrixXd& a) {
  const Eigen::ComplexSchur<Eigen::MatrixXd> schur(a);
  u_ = schur.matrixU();
  t_ = schur.matrixT();
}

double Lyapunov::largest_real_part() const { return t_.diagonal().real().maxCoeff(); }

Eigen::MatrixXd Lyapunov::solve(const Eigen::MatrixXd& q) const {
  // T Y + Y T* = F, column by column from the last.
  const Eigen::MatrixXcd f = -(u_.adjoint() * q * u_);
  Eigen::MatrixXcd y = Eigen::MatrixXcd::Zero(t_.rows(), t_.cols());
  for (Eigen::Index j = t_.rows() - 1; j >= 0; --j) {
    const Eigen::Index behind = t_.rows() - 1 - j;
    Eigen::VectorXcd right = f.col(j) - y.rightCols(behind) * t_.row(j).tail(behind).adjoint();
    Eigen::MatrixXcd shifted = t_;
    shifted.diagonal().array() += std::conj(t_(j, j));
    shifted.triangularView<Eigen::Upper>().solveInPlace(right);
    y.col(j) = right;
  }
  const Eigen::MatrixXd x = (u_ * y * u_.adjoint()).real();
  return 0.5 * (x + x.transpose());
}

}  // namespace tactile_net

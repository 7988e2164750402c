#include "numeric/lyapunov.hpp"

#include <Eigen/Eigenvalues>
#include <complex>

namespace tactile_net {

Eigen::MatrixXd solve_lyapunov(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q) {
  const Eigen::ComplexSchur<Eigen::MatrixXd> schur(a);
  const Eigen::MatrixXcd& u = schur.matrixU();
  const Eigen::MatrixXcd& t = schur.matrixT();
  // T Y + Y T* = F, column by column from the last.
  const Eigen::MatrixXcd f = -(u.adjoint() * q * u);
  Eigen::MatrixXcd y = Eigen::MatrixXcd::Zero(a.rows(), a.cols());
  for (Eigen::Index j = a.rows() - 1; j >= 0; --j) {
    const Eigen::Index behind = a.rows() - 1 - j;
    Eigen::VectorXcd right = f.col(j) - y.rightCols(behind) * t.row(j).tail(behind).adjoint();
    Eigen::MatrixXcd shifted = t;
    shifted.diagonal().array() += std::conj(t(j, j));
    shifted.triangularView<Eigen::Upper>().solveInPlace(right);
    y.col(j) = right;
  }
  const Eigen::MatrixXd x = (u * y * u.adjoint()).real();
  return 0.5 * (x + x.transpose());
}

}  // namespace tactile_net

#include <Eigen/QR>

#include "numeric/decompositions.hpp"

namespace tactile_net {

Eigen::MatrixXd qr_triangle(const Eigen::MatrixXd& a) {
  return a.householderQr().matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.householderQr().solve(b);
}

Eigen::MatrixXd solve_upper(const Eigen::MatrixXd& r, const Eigen::MatrixXd& b) {
  return r.triangularView<Eigen::Upper>().solve(b);
}

Eigen::MatrixXd divide_upper(const Eigen::MatrixXd& b, const Eigen::MatrixXd& r) {
  return r.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(b);
}

}  // namespace tactile_net

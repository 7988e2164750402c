#include "numeric/decompositions.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace tactile_net {

Svd singular_value_decomposition(const Eigen::MatrixXd& a) {
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) {
  return Eigen::BDCSVD<Eigen::MatrixXd>(a).singularValues();
}

ComplexSvd singular_value_decomposition(const Eigen::MatrixXcd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

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

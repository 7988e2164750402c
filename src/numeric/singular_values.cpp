#include <Eigen/SVD>
#include <utility>

#include "numeric/decompositions.hpp"

namespace tactile_net {

Svd singular_value_decomposition(const Eigen::MatrixXd& a) {
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Svd long_singular_value_decomposition(const Eigen::MatrixXd& a) {
  if (a.rows() < a.cols()) {
    Svd svd = long_singular_value_decomposition(Eigen::MatrixXd(a.transpose()));
    std::swap(svd.u, svd.v);
    return svd;
  }
  const HouseholderQr qr(a);
  Svd svd = singular_value_decomposition(qr.triangle());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  u.topRows(a.cols()) = svd.u;
  svd.u = qr.rotate_back(u);
  return svd;
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) {
  return Eigen::BDCSVD<Eigen::MatrixXd>(a).singularValues();
}

}  // namespace tactile_net

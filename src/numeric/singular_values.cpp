#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/decompositions.hpp"

namespace tactile_net {

Svd singular_value_decomposition(const Eigen::MatrixXd& a) {
  constexpr int thin = Eigen::ComputeThinU | Eigen::ComputeThinV;
#if EIGEN_MAJOR_VERSION < 5  // 3.4, whose type has no place for them
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(a, thin);
#else
  const Eigen::BDCSVD<Eigen::MatrixXd, thin> svd(a);
#endif
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Svd long_singular_value_decomposition(const Eigen::MatrixXd& a) {
  if (a.rows() < a.cols()) {
    Svd svd = long_singular_value_decomposition(Eigen::MatrixXd(a.transpose()));
    std::swap(svd.u, svd.v);
    return svd;
  }
  // Reflections square entries; a power of two scales them without a rounding.
  int exponent = 0;
  std::frexp(a.cwiseAbs().maxCoeff(), &exponent);
  const double size = std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
  const HouseholderQr qr(a / size);
  Svd svd = singular_value_decomposition(qr.triangle());
  svd.values *= size;
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  u.topRows(a.cols()) = svd.u;
  svd.u = qr.rotate_back(u);
  return svd;
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) {
  return Eigen::BDCSVD<Eigen::MatrixXd>(a).singularValues();
}

}  // namespace tactile_net

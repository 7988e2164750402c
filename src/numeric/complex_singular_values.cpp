#include <Eigen/SVD>

#include "numeric/decompositions.hpp"

namespace tactile_net {

ComplexSvd singular_value_decomposition(const Eigen::MatrixXcd& a) {
  constexpr int thin = Eigen::ComputeThinU | Eigen::ComputeThinV;
#if EIGEN_MAJOR_VERSION < 5  // 3.4, whose type has no place for them
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a, thin);
#else
  const Eigen::JacobiSVD<Eigen::MatrixXcd, thin> svd(a);
#endif
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

}  // namespace tactile_net

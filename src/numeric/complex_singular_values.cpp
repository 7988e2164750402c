#include <Eigen/SVD>

#include "numeric/decompositions.hpp"

namespace tactile_net {

ComplexSvd singular_value_decomposition(const Eigen::MatrixXcd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

}  // namespace tactile_net

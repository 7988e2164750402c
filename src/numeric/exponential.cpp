#include <unsupported/Eigen/MatrixFunctions>

#include "numeric/decompositions.hpp"

namespace tactile_net {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& a) { return a.exp(); }

}  // namespace tactile_net

#include "tactile_net/grasp/space/space_action.hpp"

#include <cmath>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

FrictionMargin friction_margin(const SpaceAction& action, double friction) {
  const double size = action.slipping();
  const double per_torsion = action.torsion_radius ? 1.0 / *action.torsion_radius : 0.0;
  // In forces: (F_x, F_y, F_z, T / radius).
  const Eigen::Vector4d units(1.0, 1.0, 1.0, per_torsion);
  const Eigen::Matrix4d c =
      units.asDiagonal() *
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(action.covariance.data()) *
      units.asDiagonal();
  double deviation = 0.0;
  if (size > 0.0) {
    const Eigen::Vector4d across(friction, -action.tangential_y / size, -action.tangential_z / size,
                                 -per_torsion * action.torsion / size);
    deviation = std::sqrt(std::fmax(across.dot(c * across), 0.0));
  } else {
    deviation = friction * std::sqrt(std::fmax(c(0, 0), 0.0)) +
                std::sqrt(std::fmax(
                    symmetric_eigenvalues(Eigen::MatrixXd(c.bottomRightCorner<3, 3>()))(2), 0.0));
  }
  return friction_margin(action.normal, size, deviation, friction);
}

}  // namespace tactile_net

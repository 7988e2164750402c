#include "tactile_net/grasp/measured_grasp.hpp"

#include "grasp/chi_squared.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/grasp/in_space.hpp"
#include "tactile_net/grasp/space/measured_space_grasp.hpp"

namespace tactile_net {

MeasuredGrasp measured_grasp(std::span<const Finger> fingers,
                             std::span<const FingertipForce> forces, const ExternalLoad& load) {
  std::vector<SpaceFinger> lifted;
  std::vector<SpaceFingertipForce> felt;
  for (const Finger& finger : fingers) lifted.push_back(in_space(finger));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (i < fingers.size()) check(fingers[i], forces[i]);
    felt.push_back(in_space(forces[i]));
  }
  const MeasuredSpaceGrasp grasp = measured_grasp(lifted, felt, in_space(load));

  MeasuredGrasp result{.fingers = in_plane(grasp.fingers),
                       .torque_covariance = grasp.torque_covariance,
                       .unbalanced_share = grasp.unbalanced_share,
                       .squeeze = grasp.squeeze,
                       .grasping_force = grasp.grasping_force};
  constexpr std::array<std::size_t, 3> sums = {0, 1, 5};  // forces along X and Y, moment
  Eigen::VectorXd unbalanced(3);
  Eigen::MatrixXd c(3, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.unbalanced[i] = grasp.unbalanced[sums[i]];
    unbalanced(at) = result.unbalanced[i].value;
    for (std::size_t j = 0; j < 3; ++j)
      c(at, static_cast<Eigen::Index>(j)) = grasp.unbalanced_covariance(sums[i], sums[j]);
  }
  result.chi_squared = chi_squared(unbalanced, c);
  return result;
}

}  // namespace tactile_net

/// @file
/// A grasp's maps from contact forces to torques and to the object's wrench, with their derivatives
/// by the contacts' places. Forces are f = (f_1x, f_1y, f_2x, ...), in the palm's frame. Private.
#pragma once

#include <span>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

class GraspMap {
 public:
  /// @param centres  y* of every contact, one per finger
  GraspMap(std::span<const Finger> fingers, std::span<const double> centres);

  [[nodiscard]] std::size_t contacts() const noexcept { return poses_.size(); }
  [[nodiscard]] const FingerPose& pose(std::size_t finger) const { return poses_[finger]; }
  [[nodiscard]] Vector2 point(std::size_t finger) const { return points_[finger]; }
  [[nodiscard]] Vector2 middle() const noexcept { return middle_; }

  /// Root of the mean square distance of the contacts from their middle: the grasp's length.
  [[nodiscard]] double spread() const noexcept { return spread_; }
  /// False if the contacts are one point, or nearly.
  [[nodiscard]] bool has_spread() const noexcept;

  /// T, joints x 2 contacts: tau = T f.
  [[nodiscard]] Eigen::MatrixXd torques() const;
  /// dT/dy f of the contact's place: what every joint of its finger gains.
  [[nodiscard]] double torque_change(std::size_t finger, Vector2 force) const {
    return cross(poses_[finger].along, force);
  }
  /// Where a finger's joints begin among all joints; of `contacts()`: how many joints there are.
  [[nodiscard]] Eigen::Index first_joint(std::size_t finger) const { return first_joint_[finger]; }

  /// G, 3 x 2 contacts: forces along X and Y, moment about a point.
  [[nodiscard]] Eigen::MatrixXd wrench(Vector2 about) const;

  /// e_i, from contact i to the contacts' middle. A contact in the middle has none: NaN.
  [[nodiscard]] Vector2 inward(std::size_t contact) const;
  /// de_i / dy of finger `by`.
  [[nodiscard]] Vector2 inward_change(std::size_t contact, std::size_t by) const;

  /// What each finger does, with deviations.
  ///
  /// @param f               contact forces
  /// @param by_parameters   df / dp, 2 contacts x parameters
  /// @param torques_by      dtau / dp, joints x parameters
  /// @param covariance      of p
  [[nodiscard]] std::vector<FingerAction> actions(const Eigen::VectorXd& f,
                                                  const Eigen::MatrixXd& by_parameters,
                                                  const Eigen::MatrixXd& torques_by,
                                                  const Eigen::MatrixXd& covariance) const;

 private:
  std::vector<FingerPose> poses_;
  std::vector<Vector2> points_;
  std::vector<Eigen::Index> first_joint_;
  Vector2 middle_;
  double spread_ = 0.0;
};

[[nodiscard]] inline Vector2 force_of(const Eigen::VectorXd& f, std::size_t contact) {
  const auto i = static_cast<Eigen::Index>(2 * contact);
  return {f(i), f(i + 1)};
}

[[nodiscard]] bool all_finite(const ExternalLoad& load) noexcept;

}  // namespace tactile_net

/// @file
/// The maps of a grasp in space, from what pads feel to torques and to the object's wrench, with
/// their derivatives by the contacts' places. Four columns a contact: F_x, F_y, F_z and torsion, of
/// the object on the pad. Private.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/grasp/space/space_action.hpp"
#include "tactile_net/grasp/space/space_contact.hpp"
#include "tactile_net/grasp/space/space_finger.hpp"

namespace tactile_net {

/// Of the largest singular value: below it a direction is not moved at all.
inline constexpr double rank_rounding = 1e-10;

[[nodiscard]] inline Eigen::Vector3d column_of(Vector3 v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Vector3 vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

class SpaceMap {
 public:
  SpaceMap(std::span<const SpaceFinger> fingers, std::span<const SpaceContactPlace> places);

  [[nodiscard]] std::size_t contacts() const noexcept { return points_.size(); }
  [[nodiscard]] const PadFrame& frame(std::size_t finger) const { return frames_[finger]; }
  [[nodiscard]] Vector3 point(std::size_t finger) const { return points_[finger]; }
  [[nodiscard]] Vector3 middle() const noexcept { return middle_; }
  /// Root of the mean square distance of the contacts from their middle: the grasp's length.
  [[nodiscard]] double spread() const noexcept { return spread_; }
  /// False if the contacts are one point, or nearly.
  [[nodiscard]] bool has_spread() const noexcept;
  /// Where a finger's joints begin among all joints; of `contacts()`: how many joints there are.
  [[nodiscard]] Eigen::Index first_joint(std::size_t finger) const { return first_joint_[finger]; }

  /// T, joints x 4 contacts.
  [[nodiscard]] Eigen::MatrixXd torques() const;
  /// G, 6 x 4 contacts: forces, and moments about a point.
  [[nodiscard]] Eigen::MatrixXd wrench(Vector3 about) const;
  /// By a contact's moving along `way`, of the columns of `finger` alone: joints of that finger x 4
  /// and 6 x 4.
  [[nodiscard]] Eigen::MatrixXd torque_change(std::size_t finger, Vector3 way) const;
  [[nodiscard]] Eigen::Matrix<double, 6, 4> wrench_change(std::size_t finger, Vector3 way) const;

  /// e_i, from a contact to the middle; of a contact in the middle NaN.
  [[nodiscard]] Vector3 inward(std::size_t contact) const;
  /// By `way` of the contact of finger `by`.
  [[nodiscard]] Vector3 inward_change(std::size_t contact, std::size_t by, Vector3 way) const;
  /// The sum of the forces' components inwards: 1 x 4 contacts; a contact in the middle has none.
  [[nodiscard]] Eigen::RowVectorXd squeeze() const;

  /// What each finger does, with deviations.
  ///
  /// @param felt         4 contacts
  /// @param felt_by      dfelt / dp, 4 contacts x parameters
  /// @param torques_by   dtau / dp
  /// @param covariance   of p
  [[nodiscard]] std::vector<SpaceAction> actions(const Eigen::VectorXd& felt,
                                                 const Eigen::MatrixXd& felt_by,
                                                 const Eigen::MatrixXd& torques_by,
                                                 const Eigen::MatrixXd& covariance) const;

 private:
  /// Of a force on the pad along one of its axes, and of torsion, what the object feels.
  [[nodiscard]] std::array<Vector3, 3> pushes(std::size_t finger) const;

  std::vector<PadFrame> frames_;
  std::vector<Vector3> points_;
  std::vector<std::optional<double>> radii_;
  std::vector<std::vector<JointMotion>> motions_;
  std::vector<Eigen::Index> first_joint_;
  Vector3 middle_;
  double spread_ = 0.0;
};

}  // namespace tactile_net

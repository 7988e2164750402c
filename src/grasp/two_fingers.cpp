#include "tactile_net/grasp/two_fingers.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"
#include "tactile_net/grasp/in_space.hpp"

namespace tactile_net {
namespace {

/// r^frame = A r^palm + b.
struct Transform {
  Eigen::Matrix2d a;
  Eigen::Vector2d b;
};

Eigen::Vector2d in_eigen(Vector2 v) { return {v.x, v.y}; }

/// One finger in its own fingertip's frame: y along the pad, the origin at the contact.
struct Fingertip {
  Transform from_palm;       // T_pl or T_pr
  Eigen::Matrix2d jacobian;  // J: velocity of the contact by the joints' rates
  double reach = 0.0;        // the longest arm

  Fingertip(const Finger& finger, double centre) {
    if (finger.links.size() != 2)
      throw std::invalid_argument("finger '" + finger.name + "': it must have two links");
    check(finger, ContactPlace{centre, 0.0});
    const FingerPose pose = pose_of(finger);
    const Vector2 origin = contact_point(pose, centre);
    check_bent(finger, pose, origin);
    const Vector2 x = -quarter_turn(pose.along);
    from_palm.a << x.x, x.y, pose.along.x, pose.along.y;
    from_palm.b = -from_palm.a * in_eigen(origin);
    for (std::size_t joint = 0; joint < 2; ++joint) {
      const Vector2 arm = origin - pose.joints[joint];
      reach = std::max(reach, length(arm));
      jacobian.col(static_cast<Eigen::Index>(joint)) = from_palm.a * in_eigen(quarter_turn(arm));
    }
  }

  /// J^-T: from torques, divided by the reach, to the force on the object.
  [[nodiscard]] Eigen::Matrix2d force_by_torque() const {
    return (jacobian / reach).inverse().transpose();
  }
};

Eigen::RowVector2d moment_row(const Eigen::Vector2d& r) { return {-r.y(), r.x()}; }

}  // namespace

TwoFingerTorques two_finger_torques(const Finger& left, double left_centre, const Finger& right,
                                    double right_centre, const ExternalLoad& load,
                                    double grasping_force) {
  if (!is_finite(in_space(load)) || !std::isfinite(grasping_force))
    throw std::invalid_argument("the external load and the grasping force must be finite");
  const Fingertip l(left, left_centre);
  const Fingertip r(right, right_centre);
  const Eigen::Matrix2d a_rl = l.from_palm.a * r.from_palm.a.transpose();
  const Eigen::Vector2d b_rl = l.from_palm.b - a_rl * r.from_palm.b;
  const double distance = b_rl.norm();
  if (!(distance > 1e-9 * std::max(l.reach, r.reach)))
    throw std::invalid_argument("the contacts coincide: no line joins them");
  const Eigen::Vector2d e = b_rl / distance;
  const Eigen::Vector2d p_b = l.from_palm.a * in_eigen(load.point) + l.from_palm.b;
  const Eigen::Vector2d f_e = l.from_palm.a * in_eigen(load.force);

  const Eigen::Matrix2d by_left = l.force_by_torque();
  const Eigen::Matrix2d by_right = a_rl * r.force_by_torque();
  Eigen::Matrix4d j = Eigen::Matrix4d::Zero();
  j.topLeftCorner<2, 2>() = by_left;
  j.topRightCorner<2, 2>() = by_right;
  j.block<1, 2>(2, 2) = moment_row(b_rl) / distance * by_right;
  j.block<1, 2>(3, 0) = e.transpose() * by_left;
  j.block<1, 2>(3, 2) = -e.transpose() * by_right;
  Eigen::Vector4d right_side;
  right_side.head<2>() = -f_e;
  right_side(2) = -(moment_row(p_b).dot(f_e) + load.torque) / distance;
  right_side(3) = grasping_force + std::abs(e.dot(f_e));

  const Eigen::Vector4d tau = pivoted_least_squares(j, right_side);
  const Eigen::Vector4d singular = singular_values(j);
  return {.left = {l.reach * tau(0), l.reach * tau(1)},
          .right = {r.reach * tau(2), r.reach * tau(3)},
          .condition = singular(0) / singular(3)};
}

}  // namespace tactile_net

/// @file
/// Random hands in space, and turning, moving and embedding them.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "tactile_net/grasp/space/hold_in_space.hpp"
#include "tactile_net/grasp/space/measured_space_grasp.hpp"
#include "tests/grasp/hands.hpp"

namespace tactile_net {

struct SpaceHand {
  std::vector<SpaceFinger> fingers{};
  std::vector<SpaceFingertipForce> forces{};
  SpaceLoad load{};

  [[nodiscard]] std::vector<SpaceContactPlace> places() const {
    std::vector<SpaceContactPlace> all;
    for (const SpaceFingertipForce& force : forces) all.push_back(place_of(force));
    return all;
  }
};

inline Vector3 random_vector(Random& random, double size) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

inline Eigen::Vector3d column(Vector3 v) { return {v.x, v.y, v.z}; }
inline Vector3 vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Contacts all around a ball of radius 1 whose normals point outwards, so that fingers can press.
///
/// @param soft  how many of the fingers bear torsion
inline SpaceHand random_space_hand(Random& random, std::size_t fingers, std::size_t joints,
                                   std::size_t soft) {
  SpaceHand hand;
  for (std::size_t i = 0; i < fingers; ++i) {
    const double angle = 2.0 * std::numbers::pi *
                         (static_cast<double>(i) + random.between(-0.2, 0.2)) /
                         static_cast<double>(fingers);
    const Vector3 out{std::cos(angle), std::sin(angle), random.between(-0.3, 0.3)};
    SpaceFinger finger{.name = "finger " + std::to_string(i), .place = out, .normal = out};
    finger.tangent = cross(out, random_vector(random, 1.0));
    for (std::size_t j = 0; j < joints; ++j)
      finger.joints.push_back({2.0 * out + random_vector(random, 1.0), random_vector(random, 1.0)});
    SpaceFingertipForce force{.normal = random.between(0.5, 2.0),
                              .tangential_y = random.between(-1.0, 1.0),
                              .tangential_z = random.between(-1.0, 1.0),
                              .place = {random.between(-0.1, 0.1), random.between(-0.1, 0.1)}};
    if (i < soft) {
      force.torsion = random.between(-0.2, 0.2);
      force.place.torsion_radius = random.between(0.1, 0.4);
    }
    Eigen::Matrix<double, 6, 6> root;
    for (double& value : root.reshaped()) value = 0.01 * random.normal();
    if (i >= soft) root.row(5).setZero();
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(force.covariance.data()) =
        root * root.transpose();
    hand.fingers.push_back(finger);
    hand.forces.push_back(force);
  }
  hand.load = {random_vector(random, 1.0), random_vector(random, 0.2), random_vector(random, 0.3)};
  return hand;
}

/// The same hand in a frame that is turned and moved.
inline SpaceHand moved(SpaceHand hand, const Eigen::AngleAxisd& turn, Vector3 by) {
  const auto way = [&](Vector3 v) { return vector(turn * column(v)); };
  for (SpaceFinger& finger : hand.fingers) {
    finger.place = way(finger.place) + by;
    finger.normal = way(finger.normal);
    finger.tangent = way(finger.tangent);
    for (SpaceJoint& joint : finger.joints) {
      joint.place = way(joint.place) + by;
      joint.axis = way(joint.axis);
    }
  }
  hand.load = {way(hand.load.force), way(hand.load.torque), way(hand.load.point) + by};
  return hand;
}

/// Force and moment about the origin of all that acts on the object.
inline Eigen::Matrix<double, 6, 1> sum_of(const std::vector<SpaceAction>& actions,
                                          const SpaceLoad& load) {
  Eigen::Matrix<double, 6, 1> sum;
  sum << column(load.force), column(load.torque + cross(load.point, load.force));
  for (const SpaceAction& action : actions) {
    sum.head<3>() += column(action.force);
    sum.tail<3>() += column(cross(action.point, action.force) + action.moment);
  }
  return sum;
}

}  // namespace tactile_net

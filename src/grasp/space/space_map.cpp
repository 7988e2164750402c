#include "grasp/space/space_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactile_net {

SpaceMap::SpaceMap(std::span<const SpaceFinger> fingers,
                   std::span<const SpaceContactPlace> places) {
  Eigen::Index joints = 0;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    frames_.push_back(pad_frame(fingers[i]));
    points_.push_back(contact_point(frames_.back(), places[i].y, places[i].z));
    radii_.push_back(places[i].torsion_radius);
    first_joint_.push_back(joints);
    motions_.emplace_back();
    for (std::size_t j = 0; j < joint_count(fingers[i]); ++j) {
      JointMotion motion = motion_of(fingers[i], j);
      motion.velocity = motion.velocity + cross(motion.turn, points_[i] - fingers[i].place);
      motions_.back().push_back(motion);
      ++joints;
    }
  }
  first_joint_.push_back(joints);
  const double share = 1.0 / static_cast<double>(contacts());
  for (const Vector3 point : points_) middle_ = middle_ + share * point;
  for (const Vector3 point : points_) spread_ = std::hypot(spread_, length(point - middle_));
  spread_ *= std::sqrt(share);
}

bool SpaceMap::has_spread() const noexcept {
  double reach = 0.0;
  for (std::size_t i = 0; i < contacts(); ++i)
    reach = std::max({reach, length(points_[i]), length(points_[i] - frames_[i].origin)});
  return spread_ > 1e-9 * reach;
}

std::array<Vector3, 3> SpaceMap::pushes(std::size_t finger) const {
  const PadFrame& pad = frames_[finger];
  return {-pad.x, -pad.y, -pad.z};
}

Eigen::MatrixXd SpaceMap::torques() const {
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(first_joint_.back(), 4 * std::ssize(points_));
  for (std::size_t i = 0; i < contacts(); ++i) {
    const auto column = static_cast<Eigen::Index>(4 * i);
    Eigen::Index row = first_joint_[i];
    for (const JointMotion& joint : motions_[i]) {
      Eigen::Index k = column;
      for (const Vector3 push : pushes(i)) t(row, k++) = dot(joint.velocity, push);
      t(row++, k) = dot(joint.turn, pushes(i)[0]);
    }
  }
  return t;
}

Eigen::MatrixXd SpaceMap::wrench(Vector3 about) const {
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(6, 4 * std::ssize(points_));
  for (std::size_t i = 0; i < contacts(); ++i) {
    auto k = static_cast<Eigen::Index>(4 * i);
    for (const Vector3 push : pushes(i))
      g.col(k++) << column_of(push), column_of(cross(points_[i] - about, push));
    g.col(k).tail<3>() = column_of(pushes(i)[0]);
  }
  return g;
}

Eigen::MatrixXd SpaceMap::torque_change(std::size_t finger, Vector3 way) const {
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(std::ssize(motions_[finger]), 4);
  for (std::size_t j = 0; j < motions_[finger].size(); ++j) {
    Eigen::Index k = 0;
    for (const Vector3 push : pushes(finger))
      change(static_cast<Eigen::Index>(j), k++) = dot(cross(motions_[finger][j].turn, way), push);
  }
  return change;
}

Eigen::Matrix<double, 6, 4> SpaceMap::wrench_change(std::size_t finger, Vector3 way) const {
  Eigen::Matrix<double, 6, 4> change = Eigen::Matrix<double, 6, 4>::Zero();
  Eigen::Index k = 0;
  for (const Vector3 push : pushes(finger)) change.col(k++).tail<3>() = column_of(cross(way, push));
  return change;
}

Vector3 SpaceMap::inward(std::size_t contact) const {
  const Vector3 way = middle_ - points_[contact];
  const double distance = length(way);
  return 1.0 / (distance > 1e-9 * spread_ ? distance : std::numeric_limits<double>::quiet_NaN()) *
         way;
}

Vector3 SpaceMap::inward_change(std::size_t contact, std::size_t by, Vector3 way) const {
  const Vector3 e = inward(contact);
  const double share = 1.0 / static_cast<double>(contacts());
  const Vector3 change = (share - (contact == by ? 1.0 : 0.0)) * way;
  return 1.0 / length(middle_ - points_[contact]) * (change - dot(e, change) * e);
}

Eigen::RowVectorXd SpaceMap::squeeze() const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(4 * std::ssize(points_));
  for (std::size_t i = 0; i < contacts(); ++i) {
    const Vector3 e = inward(i);
    if (std::isnan(e.x)) continue;
    auto k = static_cast<Eigen::Index>(4 * i);
    for (const Vector3 push : pushes(i)) row(k++) = dot(e, push);
  }
  return row;
}

std::vector<SpaceAction> SpaceMap::actions(const Eigen::VectorXd& felt,
                                           const Eigen::MatrixXd& felt_by,
                                           const Eigen::MatrixXd& torques_by,
                                           const Eigen::MatrixXd& covariance) const {
  const Eigen::VectorXd tau = torques() * felt;
  std::vector<SpaceAction> actions(contacts());
  for (std::size_t i = 0; i < contacts(); ++i) {
    const auto first = static_cast<Eigen::Index>(4 * i);
    const Eigen::Vector4d f = felt.segment<4>(first);
    const PadFrame& pad = frames_[i];
    SpaceAction& action = actions[i];
    action.point = points_[i];
    action.force = -(f(0) * pad.x + f(1) * pad.y + f(2) * pad.z);
    action.moment = -(f(3) * pad.x);
    action.normal = f(0);
    action.tangential_y = f(1);
    action.tangential_z = f(2);
    action.torsion = f(3);
    action.torsion_radius = radii_[i];
    const Eigen::MatrixXd by = felt_by.middleRows<4>(first);
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(action.covariance.data()) =
        by * covariance * by.transpose();
    for (Eigen::Index j = first_joint_[i]; j < first_joint_[i + 1]; ++j) {
      const Eigen::RowVectorXd row = torques_by.row(j);
      action.torques.push_back({tau(j), std::sqrt(std::max((row * covariance).dot(row), 0.0))});
    }
  }
  return actions;
}

}  // namespace tactile_net

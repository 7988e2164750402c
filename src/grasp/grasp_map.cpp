#include "grasp/grasp_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactile_net {

GraspMap::GraspMap(std::span<const Finger> fingers, std::span<const double> centres) {
  Eigen::Index joints = 0;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    poses_.push_back(pose_of(fingers[i]));
    points_.push_back(contact_point(poses_.back(), centres[i]));
    first_joint_.push_back(joints);
    joints += std::ssize(poses_.back().joints);
  }
  first_joint_.push_back(joints);
  const double share = 1.0 / static_cast<double>(contacts());
  for (const Vector2 point : points_) middle_ = middle_ + share * point;
  for (const Vector2 point : points_) spread_ = std::hypot(spread_, length(point - middle_));
  spread_ *= std::sqrt(share);
}

bool GraspMap::has_spread() const noexcept {
  double reach = 0.0;
  for (std::size_t i = 0; i < contacts(); ++i)
    for (const Vector2 joint : poses_[i].joints)
      reach = std::max(reach, length(points_[i] - joint));
  return spread_ > 1e-9 * reach;
}

Eigen::MatrixXd GraspMap::torques() const {
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(first_joint_.back(), 2 * std::ssize(points_));
  for (std::size_t i = 0; i < contacts(); ++i) {
    const auto column = static_cast<Eigen::Index>(2 * i);
    Eigen::Index row = first_joint_[i];
    for (const Vector2 joint : poses_[i].joints) {
      const Vector2 turn = quarter_turn(points_[i] - joint);
      t(row, column) = turn.x;
      t(row++, column + 1) = turn.y;
    }
  }
  return t;
}

Eigen::MatrixXd GraspMap::wrench(Vector2 about) const {
  Eigen::MatrixXd g(3, 2 * std::ssize(points_));
  for (std::size_t i = 0; i < contacts(); ++i) {
    const Vector2 turn = quarter_turn(points_[i] - about);
    g.middleCols<2>(static_cast<Eigen::Index>(2 * i)) << 1.0, 0.0, 0.0, 1.0, turn.x, turn.y;
  }
  return g;
}

Vector2 GraspMap::inward(std::size_t contact) const {
  const Vector2 way = middle_ - points_[contact];
  const double distance = length(way);
  return 1.0 / (distance > 1e-9 * spread_ ? distance : std::numeric_limits<double>::quiet_NaN()) *
         way;
}

Vector2 GraspMap::inward_change(std::size_t contact, std::size_t by) const {
  const Vector2 along = poses_[by].along;
  const Vector2 e = inward(contact);
  const double share = 1.0 / static_cast<double>(contacts());
  const Vector2 change = (share - (contact == by ? 1.0 : 0.0)) * along;
  return 1.0 / length(middle_ - points_[contact]) * (change - dot(e, change) * e);
}

std::vector<FingerAction> GraspMap::actions(const Eigen::VectorXd& f,
                                            const Eigen::MatrixXd& by_parameters,
                                            const Eigen::MatrixXd& torques_by,
                                            const Eigen::MatrixXd& covariance) const {
  const Eigen::VectorXd tau = torques() * f;
  const auto deviation = [&](const Eigen::RowVectorXd& row) {
    return std::sqrt(std::max((row * covariance).dot(row), 0.0));
  };
  std::vector<FingerAction> actions(contacts());
  for (std::size_t i = 0; i < contacts(); ++i) {
    const FingerPose& pose = poses_[i];
    FingerAction& action = actions[i];
    action.point = points_[i];
    action.force = force_of(f, i);
    action.normal = 0.0 - dot(action.force, pose.inward);  // no negative zero
    action.tangential = 0.0 - dot(action.force, pose.along);
    Eigen::Matrix2d axes;
    axes << pose.inward.x, pose.inward.y, pose.along.x, pose.along.y;
    const Eigen::MatrixXd felt =
        axes * by_parameters.middleRows<2>(static_cast<Eigen::Index>(2 * i));
    const Eigen::Matrix2d c = felt * covariance * felt.transpose();
    action.covariance.values = {c(0, 0), c(0, 1), c(1, 0), c(1, 1)};
    for (Eigen::Index j = first_joint_[i]; j < first_joint_[i + 1]; ++j)
      action.torques.push_back({tau(j), deviation(torques_by.row(j))});
  }
  return actions;
}

bool all_finite(const ExternalLoad& load) noexcept {
  return std::isfinite(load.force.x) && std::isfinite(load.force.y) && std::isfinite(load.torque) &&
         std::isfinite(load.point.x) && std::isfinite(load.point.y);
}

}  // namespace tactile_net

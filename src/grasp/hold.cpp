#include "tactile_net/grasp/hold.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>
#include <string>

#include "grasp/grasp_map.hpp"
#include "grasp/least_torques.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double degenerate = 1e12;  // condition number beyond which torques are rounding

void check(std::span<const Finger> fingers, std::span<const ContactPlace> contacts,
           const ExternalLoad& load, const HoldOptions& options) {
  const auto require = [](bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument(rule);
  };
  require(fingers.size() >= 2, "a grasp needs at least two fingers");
  require(contacts.size() == fingers.size(), "there must be one contact for each finger");
  require(all_finite(load), "the external load must be finite");
  require(!options.grasping_force || !options.squeeze,
          "grasping force and squeeze exclude each other");
  require(!options.grasping_force || fingers.size() == 2,
          "a grasping force is defined for two fingers; give a squeeze");
  require(std::isfinite(options.grasping_force.value_or(0.0)) &&
              std::isfinite(options.squeeze.value_or(0.0)),
          "the grasping force must be finite");
  require(options.friction.empty() || options.friction.size() == fingers.size(),
          "there must be one coefficient of friction for each finger, or none");
  for (const double friction : options.friction)
    require(friction > 0.0 && std::isfinite(friction), "friction must be > 0 and finite");
  for (std::size_t i = 0; i < fingers.size(); ++i) check(fingers[i], contacts[i]);
}

void check(std::span<const Finger> fingers, const GraspMap& map, bool squeezed) {
  if (!map.has_spread()) throw std::invalid_argument("the contacts coincide: no line joins them");
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    check_bent(fingers[i], map.pose(i), map.point(i));
    if (squeezed && std::isnan(map.inward(i).x))
      throw std::invalid_argument(
          "finger '" + fingers[i].name +
          "': its contact is in the middle of all contacts, where no direction "
          "is inward to squeeze");
  }
}

/// The edges of the fingers' cones of friction, as unit forces on the object; without friction the
/// palm's axes.
Eigen::MatrixXd edges(const GraspMap& map, const std::vector<double>& friction) {
  const auto n = static_cast<Eigen::Index>(2 * map.contacts());
  Eigen::MatrixXd b = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t i = 0; i < friction.size(); ++i) {
    const FingerPose& pose = map.pose(i);
    const double scale = 1.0 / std::hypot(1.0, friction[i]);
    const auto at = static_cast<Eigen::Index>(2 * i);
    const Vector2 one = -scale * (pose.inward + friction[i] * pose.along);
    const Vector2 other = -scale * (pose.inward - friction[i] * pose.along);
    b.block<2, 2>(at, at) << one.x, other.x, one.y, other.y;
  }
  return b;
}

}  // namespace

HeldGrasp hold(std::span<const Finger> fingers, std::span<const ContactPlace> contacts,
               const ExternalLoad& load, const HoldOptions& options) {
  check(fingers, contacts, load, options);
  const std::size_t m = fingers.size();
  const auto forces = static_cast<Eigen::Index>(2 * m);
  const bool squeezed = options.grasping_force || options.squeeze;
  std::vector<double> centres;
  for (const ContactPlace& contact : contacts) centres.push_back(contact.centre);
  const GraspMap map(fingers, centres);
  check(fingers, map, squeezed);

  const double size = map.spread();
  const Eigen::MatrixXd t = map.torques();
  const Eigen::MatrixXd b = edges(map, options.friction);
  const Eigen::Index joints = t.rows();
  Eigen::MatrixXd c(squeezed ? 4 : 3, forces);
  Eigen::VectorXd d(c.rows());
  c.topRows<3>() = map.wrench(map.middle());
  c.row(2) /= size;
  d.head<3>() << -load.force.x, -load.force.y,
      -(load.torque + cross(load.point - map.middle(), load.force)) / size;
  // Of the two fingers' line; the load presses one of them with |e.f_e|.
  const double pressed = options.grasping_force ? dot(map.inward(0), load.force) : 0.0;
  if (squeezed) {
    for (std::size_t i = 0; i < m; ++i) {
      const Vector2 e = map.inward(i);
      c.block<1, 2>(3, static_cast<Eigen::Index>(2 * i)) << e.x, e.y;
    }
    d(3) = options.squeeze ? *options.squeeze : *options.grasping_force + std::abs(pressed);
  }
  const LeastTorques least{t * b / size, c * b, d, !options.friction.empty()};

  HeldGrasp result;
  const auto condition_of = [](const Eigen::MatrixXd& k) {
    const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(k).singularValues();
    return singular(0) / singular(singular.size() - 1);
  };
  if (!(condition_of(least.system()) < degenerate))
    throw std::domain_error(
        "the torques do not determine the contact forces: some forces of the fingers against each "
        "other pass through their joints and cost none");
  const auto held = least.held_bounds();
  if (!held)
    throw std::domain_error(
        squeezed ? "no forces within the friction cones carry the load with that squeeze"
                 : "no forces within the friction cones carry the load");
  const Eigen::MatrixXd k = least.system(*held);
  result.condition = condition_of(k);
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(k);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(k.rows());
  right.segment(joints, d.size()) = d;
  const Eigen::VectorXd z = lu.solve(right);
  Eigen::VectorXd v = z.tail(forces);
  for (const Eigen::Index i : *held) v(i) = 0.0;
  const Eigen::VectorXd f = b * v;

  // K dz = d(right) - dK z, for each contact's place; the cones' edges stay as they are.
  Eigen::MatrixXd by_places(forces, static_cast<Eigen::Index>(m));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(by_places.cols(), by_places.cols());
  for (std::size_t by = 0; by < m; ++by) {
    const auto column = static_cast<Eigen::Index>(by);
    const Eigen::Index first = map.first_joint(by);
    const Eigen::Index count = map.first_joint(by + 1) - first;
    const double change = map.torque_change(by, force_of(f, by)) / size;
    const Vector2 turn = quarter_turn(map.pose(by).along);
    Eigen::VectorXd rest = Eigen::VectorXd::Zero(k.rows());
    Eigen::VectorXd on_forces = Eigen::VectorXd::Zero(forces);  // before B'
    rest.segment(first, count).array() -= change;
    rest(joints + 2) -= change;
    const double moment = (z.segment(first, count).sum() + z(joints + 2)) / size;
    on_forces.segment<2>(2 * column) -= moment * Eigen::Vector2d(turn.x, turn.y);
    for (std::size_t i = 0; squeezed && i < m; ++i) {
      const Vector2 e = map.inward_change(i, by);
      rest(joints + 3) -= dot(e, force_of(f, i));
      on_forces.segment<2>(static_cast<Eigen::Index>(2 * i)) -=
          z(joints + 3) * Eigen::Vector2d(e.x, e.y);
    }
    if (options.grasping_force)
      rest(joints + 3) += std::copysign(1.0, pressed) * dot(map.inward_change(0, by), load.force);
    rest.tail(forces) = b.transpose() * on_forces;
    Eigen::VectorXd by_place = lu.solve(rest).tail(forces);
    for (const Eigen::Index i : *held) by_place(i) = 0.0;
    by_places.col(column) = b * by_place;
    covariance(column, column) = contacts[by].deviation * contacts[by].deviation;
  }
  Eigen::MatrixXd torques_by = t * by_places;
  for (std::size_t by = 0; by < m; ++by) {
    const Eigen::Index first = map.first_joint(by);
    torques_by.col(static_cast<Eigen::Index>(by))
        .segment(first, map.first_joint(by + 1) - first)
        .array() += map.torque_change(by, force_of(f, by));
  }
  result.fingers = map.actions(f, by_places, torques_by, covariance);
  result.torque_covariance = from_eigen(torques_by * covariance * torques_by.transpose());
  for (std::size_t i = 0; i < m; ++i) {
    const Vector2 e = map.inward(i);
    if (!std::isnan(e.x)) result.squeeze += dot(e, result.fingers[i].force);
  }
  return result;
}

}  // namespace tactile_net

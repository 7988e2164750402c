#include "tactile_net/grasp/hold.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "grasp/grasp_map.hpp"
#include "grasp/least_torques.hpp"
#include "numeric/decompositions.hpp"
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

double condition_of(const Eigen::MatrixXd& k) {
  const Eigen::VectorXd singular = singular_values(k);
  return singular(0) / singular(singular.size() - 1);
}

/// The grasp that is asked for: unknowns v >= 0 along the cones' edges B, or along the palm's axes
/// without friction; contact forces f = B v.
struct Task {
  const GraspMap& map;
  const ExternalLoad& load;
  const HoldOptions& options;
  bool squeezed = options.grasping_force || options.squeeze;
  double size = map.spread();  ///< what lengths are divided by, so that no equation has a unit
  Eigen::MatrixXd t = map.torques();
  Eigen::MatrixXd b = edges(map, options.friction);
  /// Along the line of two fingers; the load presses one of them with |e.f_e|.
  double pressed = options.grasping_force ? dot(map.inward(0), load.force) : 0.0;

  [[nodiscard]] Eigen::Index forces() const { return t.cols(); }
  [[nodiscard]] Eigen::Index joints() const { return t.rows(); }
};

/// Equilibrium, and the squeeze if one is asked for: C f = d.
LeastTorques least_torques(const Task& task) {
  const GraspMap& map = task.map;
  Eigen::MatrixXd c(task.squeezed ? 4 : 3, task.forces());
  Eigen::VectorXd d(c.rows());
  c.topRows<3>() = map.wrench(map.middle());
  c.row(2) /= task.size;
  d.head<3>() << -task.load.force.x, -task.load.force.y,
      -(task.load.torque + cross(task.load.point - map.middle(), task.load.force)) / task.size;
  if (task.squeezed) {
    for (std::size_t i = 0; i < map.contacts(); ++i) {
      const Vector2 e = map.inward(i);
      c.block<1, 2>(3, static_cast<Eigen::Index>(2 * i)) << e.x, e.y;
    }
    d(3) = task.options.squeeze ? *task.options.squeeze
                                : *task.options.grasping_force + std::abs(task.pressed);
  }
  return {task.t * task.b / task.size, c * task.b, d, !task.options.friction.empty()};
}

/// The least torques: the system K z = right, with the factors that its derivatives need too.
struct Minimum {
  std::vector<Eigen::Index> held;  ///< unknowns that stay 0
  double condition = 0.0;
  CompleteLu lu;
  Eigen::VectorXd z;
  Eigen::VectorXd f;

  /// The contact forces B v of a solution, or of its derivative.
  [[nodiscard]] Eigen::VectorXd forces(const Task& task, const Eigen::VectorXd& solution) const {
    Eigen::VectorXd v = solution.tail(task.forces());
    for (const Eigen::Index i : held) v(i) = 0.0;
    return task.b * v;
  }
};

Minimum minimum_of(const Task& task) {
  const LeastTorques least = least_torques(task);
  if (!(condition_of(least.system()) < degenerate)) throw CannotHold(NoHold::undetermined);
  auto held = least.held_bounds();
  if (!held) throw CannotHold(task.squeezed ? NoHold::beyond_cones_squeezed : NoHold::beyond_cones);
  const Eigen::MatrixXd k = least.system(*held);
  Minimum minimum{std::move(*held), condition_of(k), CompleteLu(k), {}, {}};
  Eigen::VectorXd right = Eigen::VectorXd::Zero(k.rows());
  right.segment(task.joints(), least.d.size()) = least.d;
  minimum.z = minimum.lu.solve(right);
  minimum.f = minimum.forces(task, minimum.z);
  return minimum;
}

/// df / dy of finger `by`'s contact: K dz = d(right) - dK z. The cones' edges stay as they are.
Eigen::VectorXd change_by_place(const Task& task, const Minimum& minimum, std::size_t by) {
  const GraspMap& map = task.map;
  const Eigen::VectorXd& z = minimum.z;
  const Eigen::Index joints = task.joints();
  const Eigen::Index first = map.first_joint(by);
  const Eigen::Index count = map.first_joint(by + 1) - first;
  const double change = map.torque_change(by, force_of(minimum.f, by)) / task.size;
  const Vector2 turn = quarter_turn(map.pose(by).along);
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(z.size());
  Eigen::VectorXd on_forces = Eigen::VectorXd::Zero(task.forces());  // before B'
  rest.segment(first, count).array() -= change;
  rest(joints + 2) -= change;
  const double moment = (z.segment(first, count).sum() + z(joints + 2)) / task.size;
  on_forces.segment<2>(static_cast<Eigen::Index>(2 * by)) -=
      moment * Eigen::Vector2d(turn.x, turn.y);
  for (std::size_t i = 0; task.squeezed && i < map.contacts(); ++i) {
    const Vector2 e = map.inward_change(i, by);
    rest(joints + 3) -= dot(e, force_of(minimum.f, i));
    on_forces.segment<2>(static_cast<Eigen::Index>(2 * i)) -=
        z(joints + 3) * Eigen::Vector2d(e.x, e.y);
  }
  if (task.options.grasping_force)
    rest(joints + 3) +=
        std::copysign(1.0, task.pressed) * dot(map.inward_change(0, by), task.load.force);
  rest.tail(task.forces()) = task.b.transpose() * on_forces;
  return minimum.forces(task, minimum.lu.solve(rest));
}

/// What the fingers do, with the deviations that those of the places mean.
HeldGrasp with_deviations(const Task& task, const Minimum& minimum,
                          std::span<const ContactPlace> contacts) {
  const GraspMap& map = task.map;
  const auto m = static_cast<Eigen::Index>(map.contacts());
  Eigen::MatrixXd by_places(task.forces(), m);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m, m);
  for (std::size_t by = 0; by < map.contacts(); ++by) {
    const auto column = static_cast<Eigen::Index>(by);
    by_places.col(column) = change_by_place(task, minimum, by);
    covariance(column, column) = contacts[by].deviation * contacts[by].deviation;
  }
  Eigen::MatrixXd torques_by = task.t * by_places;
  for (std::size_t by = 0; by < map.contacts(); ++by) {
    const Eigen::Index first = map.first_joint(by);
    torques_by.col(static_cast<Eigen::Index>(by))
        .segment(first, map.first_joint(by + 1) - first)
        .array() += map.torque_change(by, force_of(minimum.f, by));
  }
  HeldGrasp result;
  result.condition = minimum.condition;
  result.fingers = map.actions(minimum.f, by_places, torques_by, covariance);
  result.torque_covariance = from_eigen(torques_by * covariance * torques_by.transpose());
  for (std::size_t i = 0; i < map.contacts(); ++i) {
    const Vector2 e = map.inward(i);
    if (!std::isnan(e.x)) result.squeeze += dot(e, result.fingers[i].force);
  }
  return result;
}

}  // namespace

HeldGrasp hold(std::span<const Finger> fingers, std::span<const ContactPlace> contacts,
               const ExternalLoad& load, const HoldOptions& options) {
  check(fingers, contacts, load, options);
  std::vector<double> centres;
  for (const ContactPlace& contact : contacts) centres.push_back(contact.centre);
  const GraspMap map(fingers, centres);
  check(fingers, map, options.grasping_force || options.squeeze);
  const Task task{.map = map, .load = load, .options = options};
  return with_deviations(task, minimum_of(task), contacts);
}

}  // namespace tactile_net

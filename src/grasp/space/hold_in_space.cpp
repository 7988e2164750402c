#include "tactile_net/grasp/space/hold_in_space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "grasp/space/contact_columns.hpp"
#include "grasp/space/least_in_cones.hpp"
#include "grasp/space/least_on_edges.hpp"
#include "grasp/space/space_map.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double unborne = 1e-9;           // share of the load that contacts cannot bear
constexpr double believed_minimum = 1e-8;  // of what is left of the conditions for a minimum
constexpr double degenerate = 1e12;        // condition number beyond which torques are rounding

void require(bool holds, const std::string& rule) {
  if (!holds) throw std::invalid_argument(rule);
}

void check(std::span<const SpaceFinger> fingers, std::span<const SpaceContactPlace> contacts,
           const SpaceLoad& load, const HoldOptions& options) {
  require(fingers.size() >= 2, "a grasp needs at least two fingers");
  require(contacts.size() == fingers.size(), "there must be one contact for each finger");
  require(is_finite(load), "the external load must be finite");
  require(!options.grasping_force || !options.squeeze,
          "grasping force and squeeze exclude each other");
  require(!options.grasping_force || fingers.size() == 2,
          "a grasping force is defined for two fingers; give a squeeze");
  require(std::isfinite(options.grasping_force.value_or(0.0)), "the grasping force must be finite");
  require(std::isfinite(options.squeeze.value_or(0.0)), "the squeeze must be finite");
  require(options.friction.empty() || options.friction.size() == fingers.size(),
          "there must be one coefficient of friction for each finger, or none");
  for (const double friction : options.friction)
    require(friction > 0.0 && std::isfinite(friction), "friction must be > 0 and finite");
  for (std::size_t i = 0; i < fingers.size(); ++i) check(fingers[i], contacts[i]);
  if (options.least == Least::forces) return;
  bool slide = false;
  bool turn = false;
  for (const SpaceFinger& finger : fingers) {
    require(joint_count(finger) > 0,
            "finger '" + finger.name + "': without joints there are no least torques");
    for (const SpaceJoint& joint : finger.joints) (joint.slides ? slide : turn) = true;
  }
  require(!slide || !turn,
          "some joints slide and some turn: the sum of their squares has no unit; ask for the "
          "least forces");
}

/// What is asked for, in newtons and over the grasp's length: M, and C x = d with independent rows.
/// x are the contacts' forces, those of a finger with friction along its cone: (mu F_x, F_y, ...).
struct SpaceTask {
  SpaceTask(const SpaceMap& grasp, std::span<const SpaceContactPlace> contacts,
            const SpaceLoad& external, const HoldOptions& asked)
      : map(grasp), load(external), options(asked), columns(contacts) {
    if (options.grasping_force)
      squeeze = *options.grasping_force + std::abs(pressed());
    else
      squeeze = options.squeeze;
    along = Eigen::VectorXd::Ones(columns.count());
    for (std::size_t i = 0; i < options.friction.size(); ++i) {
      along(columns.first[i]) = 1.0 / options.friction[i];
      least.cones.push_back(columns.count(i));
    }
    least.m = options.least == Least::forces
                  ? Eigen::MatrixXd(along.asDiagonal())
                  : Eigen::MatrixXd(in_cones(map.torques()) / map.spread());
    all = wrench_rows(in_cones(map.wrench(map.middle())));
    wanted = Eigen::VectorXd(all.rows());
    const Vector3 moment = load.torque + cross(load.point - map.middle(), load.force);
    wanted.head<6>() << -column_of(load.force), -column_of(moment) / map.spread();
    if (squeeze) {
      all.bottomRows<1>() = in_cones(map.squeeze());
      wanted(6) = *squeeze;
    }
    const Svd svd = singular_value_decomposition(all);
    const Eigen::Index rank = (svd.values.array() > rank_rounding * svd.values(0)).count();
    range = svd.u.leftCols(rank);
    least.c = range.transpose() * all;
    least.d = range.transpose() * wanted;
  }

  /// Along the line of two fingers: the load presses one of them with its size.
  [[nodiscard]] double pressed() const { return dot(map.inward(0), load.force); }
  /// Every contact has two forces, so that its cone is two edges.
  [[nodiscard]] bool has_edges() const {
    return columns.count() == 2 * static_cast<Eigen::Index>(map.contacts());
  }
  [[nodiscard]] Eigen::MatrixXd in_cones(const Eigen::MatrixXd& matrix) const {
    return columns.of(matrix) * along.asDiagonal();
  }
  /// Moments over the grasp's length, and room for the squeeze.
  [[nodiscard]] Eigen::MatrixXd wrench_rows(const Eigen::MatrixXd& wrench) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(squeeze ? 7 : 6, wrench.cols());
    rows.topRows<6>() = wrench;
    rows.middleRows<3>(3) /= map.spread();
    return rows;
  }
  [[nodiscard]] ObjectMotion motion(const Eigen::VectorXd& of) const {
    return {map.middle(), vector_of(Eigen::Vector3d(of.head<3>())),
            vector_of(Eigen::Vector3d(of.segment<3>(3) / map.spread()))};
  }

  const SpaceMap& map;
  const SpaceLoad& load;
  const HoldOptions& options;
  ContactColumns columns;
  std::optional<double> squeeze;
  Eigen::VectorXd along;   // forces in newtons, of x
  Eigen::MatrixXd all;     // all rows of equilibrium, and the squeeze
  Eigen::VectorXd wanted;  // what they are to be
  Eigen::MatrixXd range;   // of those rows that the contacts can bear
  LeastInCones least;
};

/// A load that no forces at all carry, of whatever sign.
void refuse_unborne(const SpaceTask& task) {
  const Eigen::VectorXd left = task.wanted - task.range * (task.range.transpose() * task.wanted);
  if (!(left.norm() > unborne * task.wanted.norm())) return;
  const bool moves = left.head<6>().norm() > unborne * task.wanted.norm();
  throw CannotHoldInSpace(NoHold::no_forces,
                          moves ? std::optional(task.motion(-left / left.norm())) : std::nullopt,
                          std::nullopt);
}

/// Of the cones without the squeeze: a motion that nothing resists, or the least squeeze.
[[noreturn]] void refuse(const SpaceTask& task, const ConeAnswer& answer,
                         std::span<const SpaceContactPlace> contacts) {
  if (!task.squeeze) {
    const Eigen::VectorXd y = task.range * answer.y.tail(task.range.cols());
    throw CannotHoldInSpace(NoHold::beyond_cones, task.motion(-y / y.norm()), std::nullopt);
  }
  HoldOptions options = task.options;
  options.squeeze.reset();
  options.grasping_force.reset();
  const SpaceTask loose(task.map, contacts, task.load, options);
  refuse_unborne(loose);
  ConeProgram program{.c = loose.in_cones(task.map.squeeze()).transpose(),
                      .a = loose.least.c,
                      .b = loose.least.d,
                      .cones = loose.least.cones};
  const ConeAnswer least = solve(program);
  if (least.kind == ConeAnswer::Kind::infeasible) {
    const Eigen::VectorXd y = loose.range * least.y;
    throw CannotHoldInSpace(NoHold::beyond_cones, loose.motion(-y / y.norm()), std::nullopt);
  }
  std::optional<double> squeeze;
  if (least.kind == ConeAnswer::Kind::solved && program.c.dot(least.x) > *task.squeeze)
    squeeze = program.c.dot(least.x);
  throw CannotHoldInSpace(NoHold::beyond_cones_squeezed, std::nullopt, squeeze);
}

/// Where Newton's method may begin: the interior-point method's answer.
ConeAnswer inner_answer(const SpaceTask& task, std::span<const SpaceContactPlace> contacts) {
  Eigen::MatrixXd both(task.least.m.rows() + task.least.c.rows(), task.least.m.cols());
  const double largest = task.least.m.cwiseAbs().maxCoeff();
  both << task.least.m / (largest > 0.0 ? largest : 1.0), task.least.c;
  const Eigen::VectorXd values = singular_values(both);
  if (both.rows() < both.cols() || !(values(values.size() - 1) > rank_rounding * values(0)))
    throw CannotHoldInSpace(NoHold::undetermined, std::nullopt, std::nullopt);
  const double size = task.least.d.norm();
  if (task.least.cones.empty() || !(size > 0.0)) return {.kind = ConeAnswer::Kind::solved};
  ConeProgram program = task.least.program();
  program.b /= size;
  ConeAnswer answer = solve(program);
  using Kind = ConeAnswer::Kind;
  if (answer.kind == Kind::infeasible) refuse(task, answer, contacts);
  if (answer.kind != Kind::solved)
    throw CannotHoldInSpace(NoHold::not_found, std::nullopt, std::nullopt);
  answer.x = (size * answer.x.tail(task.least.m.cols())).eval();
  answer.s = answer.s.tail(task.least.m.cols()).eval();
  return answer;
}

/// Where every cone is two edges: by the forces along them.
EdgePoint edge_point(const SpaceTask& task) {
  const Eigen::Index n = task.least.m.cols();
  Eigen::MatrixXd edges = Eigen::MatrixXd::Identity(n, n);  // unit forces
  for (std::size_t i = 0; i < task.options.friction.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    const double mu = task.options.friction[i];
    edges.block<2, 2>(at, at) << 1.0, 1.0, 1.0, -1.0;
    edges.block<2, 2>(at, at) *= mu / std::hypot(1.0, mu);
  }
  LeastOnEdges least{task.least.m * edges, task.least.c * edges, task.least.d,
                     !task.least.cones.empty()};
  if (!(least.condition() < degenerate))
    throw CannotHoldInSpace(NoHold::undetermined, std::nullopt, std::nullopt);
  auto held = least.held_bounds();
  if (!held)
    throw CannotHoldInSpace(task.squeeze ? NoHold::beyond_cones_squeezed : NoHold::beyond_cones,
                            std::nullopt, std::nullopt);
  return {std::move(least), std::move(edges), std::move(*held)};
}

/// By the contact of finger `by` moving along `way`.
Eigen::VectorXd change_by_place(const SpaceTask& task, const auto& point,
                                const Eigen::VectorXd& felt, std::size_t by, Vector3 way) {
  const SpaceMap& map = task.map;
  const Eigen::Index four = 4 * static_cast<Eigen::Index>(by);
  Eigen::MatrixXd dt = Eigen::MatrixXd::Zero(map.first_joint(map.contacts()), felt.size());
  const Eigen::Index first = map.first_joint(by);
  dt.block(first, four, map.first_joint(by + 1) - first, 4) = map.torque_change(by, way);
  Eigen::MatrixXd dg = Eigen::MatrixXd::Zero(6, felt.size());
  dg.middleCols<4>(four) = map.wrench_change(by, way);
  Eigen::MatrixXd rows = task.wrench_rows(task.in_cones(dg));
  if (task.squeeze) {
    Eigen::MatrixXd de = Eigen::MatrixXd::Zero(1, felt.size());
    for (std::size_t i = 0; i < map.contacts(); ++i) {
      const Vector3 change = map.inward_change(i, by, way);
      const PadFrame& pad = map.frame(i);
      de.middleCols<3>(4 * static_cast<Eigen::Index>(i)) << -dot(change, pad.x),
          -dot(change, pad.y), -dot(change, pad.z);
    }
    rows.bottomRows<1>() = task.in_cones(de);
  }
  const Eigen::MatrixXd dc = task.range.transpose() * rows;
  Eigen::MatrixXd dm = Eigen::MatrixXd::Zero(task.least.m.rows(), task.least.m.cols());
  if (task.options.least == Least::torques) dm = task.in_cones(dt) / map.spread();
  const Eigen::VectorXd x = point.x();
  Eigen::VectorXd by_c = dc * x;
  if (task.options.grasping_force)
    by_c -= std::copysign(1.0, task.pressed()) *
            dot(map.inward_change(0, by, way), task.load.force) * task.range.row(6).transpose();
  return point.change(dm * x, by_c,
                      dm.transpose() * point.minus_mx() + dc.transpose() * point.multipliers());
}

HeldSpaceGrasp with_deviations(const SpaceTask& task, const auto& point,
                               std::span<const SpaceContactPlace> contacts) {
  const SpaceMap& map = task.map;
  const auto n = static_cast<Eigen::Index>(map.contacts());
  const Eigen::VectorXd felt = task.columns.felt(task.along.cwiseProduct(point.x()));
  Eigen::MatrixXd felt_by(4 * n, 2 * n);
  Eigen::MatrixXd torques_by(map.first_joint(map.contacts()), 2 * n);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (std::size_t by = 0; by < map.contacts(); ++by) {
    Eigen::Index column = 2 * static_cast<Eigen::Index>(by);
    covariance.block<2, 2>(column, column) =
        Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
            contacts[by].covariance.data());
    const Eigen::Index first = map.first_joint(by);
    for (const Vector3 way : {map.frame(by).y, map.frame(by).z}) {
      felt_by.col(column) =
          task.columns.felt(task.along.cwiseProduct(change_by_place(task, point, felt, by, way)));
      torques_by.col(column) = map.torques() * felt_by.col(column);
      torques_by.col(column++).segment(first, map.first_joint(by + 1) - first) +=
          map.torque_change(by, way) * felt.segment<4>(4 * static_cast<Eigen::Index>(by));
    }
  }
  HeldSpaceGrasp result;
  result.fingers = map.actions(felt, felt_by, torques_by, covariance);
  result.torque_covariance = from_eigen(torques_by * covariance * torques_by.transpose());
  result.squeeze = map.squeeze().dot(felt.transpose());
  result.residual = point.residual();
  result.optimality = point.optimality();
  return result;
}

}  // namespace

HeldSpaceGrasp hold(std::span<const SpaceFinger> fingers,
                    std::span<const SpaceContactPlace> contacts, const SpaceLoad& load,
                    const HoldOptions& options) {
  check(fingers, contacts, load, options);
  const SpaceMap map(fingers, contacts);
  require(map.has_spread(), "the contacts coincide: no line joins them");
  for (std::size_t i = 0; (options.squeeze || options.grasping_force) && i < fingers.size(); ++i)
    require(!std::isnan(map.inward(i).x),
            "finger '" + fingers[i].name +
                "': its contact is in the middle of all contacts, where no direction is inward to "
                "squeeze");
  const SpaceTask task(map, contacts, load, options);
  refuse_unborne(task);
  if (task.has_edges()) {
    const EdgePoint point = edge_point(task);
    HeldSpaceGrasp grasp = with_deviations(task, point, contacts);
    grasp.condition = point.condition();
    return grasp;
  }
  const ConeAnswer inner = inner_answer(task, contacts);
  const LeastPoint point(task.least, inner.x, inner.s);
  if (!(point.violation() <= believed_minimum && point.residual() <= believed_minimum &&
        point.optimality() <= believed_minimum))
    throw CannotHoldInSpace(NoHold::not_found, std::nullopt, std::nullopt);
  HeldSpaceGrasp grasp = with_deviations(task, point, contacts);
  grasp.iterations = inner.iterations;
  return grasp;
}

}  // namespace tactile_net

#include "tactile_net/grasp/space/internal_forces.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "grasp/space/contact_columns.hpp"
#include "grasp/space/space_map.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

Eigen::Index rank_of(const Eigen::VectorXd& values) {
  return values.size() == 0 || !(values(0) > 0.0)
             ? 0
             : (values.array() > rank_rounding * values(0)).count();
}

/// What G leaves free of the object, by the complement of its columns.
std::vector<ObjectMotion> free_motions(const Eigen::MatrixXd& reached, const SpaceMap& map) {
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(6, 6) - reached * reached.transpose();
  const Svd svd = singular_value_decomposition(left);
  std::vector<ObjectMotion> motions;
  for (Eigen::Index i = 0; i < 6 - reached.cols(); ++i) {
    Eigen::VectorXd way = svd.u.col(i);
    Eigen::Index largest = 0;
    way.cwiseAbs().maxCoeff(&largest);
    if (way(largest) < 0.0) way = -way;
    motions.push_back({map.middle(), vector_of(Eigen::Vector3d(map.spread() * way.head<3>())),
                       vector_of(Eigen::Vector3d(way.tail<3>()))});
  }
  return motions;
}

/// The forces of two contacts pushed against each other by 1 N, for each pair.
Eigen::MatrixXd pushes_of_pairs(const SpaceMap& map, const ContactColumns& columns,
                                std::vector<InternalForces::Pair>& pairs) {
  Eigen::MatrixXd pushes = Eigen::MatrixXd::Zero(columns.count(), 0);
  for (std::size_t a = 0; a < map.contacts(); ++a)
    for (std::size_t b = a + 1; b < map.contacts(); ++b) {
      const Vector3 way = map.point(b) - map.point(a);
      const Vector3 e = 1.0 / length(way) * way;
      pushes.conservativeResize(Eigen::NoChange, pushes.cols() + 1);
      pushes.rightCols<1>().setZero();
      for (const auto& [contact, push] : {std::pair{a, e}, std::pair{b, -e}}) {
        const PadFrame& pad = map.frame(contact);  // forces are the object's on the pad
        pushes.col(pushes.cols() - 1).segment<3>(columns.first[contact]) << -dot(push, pad.x),
            -dot(push, pad.y), -dot(push, pad.z);
      }
      pairs.push_back({a, b, 0.0});
    }
  return pushes;
}

}  // namespace

Screw screw_of(const ObjectMotion& motion, double size) {
  const double turn = length(motion.turn);
  const double speed = length(motion.velocity);
  if (!(turn * size > 1e-9 * speed))
    return {motion.point, 1.0 / speed * motion.velocity, std::numeric_limits<double>::infinity()};
  const Vector3 along = 1.0 / turn * motion.turn;
  return {motion.point + 1.0 / (turn * turn) * cross(motion.turn, motion.velocity), along,
          dot(along, motion.velocity) / turn};
}

InternalForces internal_forces(std::span<const SpaceFinger> fingers,
                               std::span<const SpaceAction> actions) {
  if (actions.size() != fingers.size())
    throw std::invalid_argument("there must be one action for each finger");
  std::vector<SpaceContactPlace> places;
  Eigen::VectorXd felt(4 * std::ssize(actions));
  bool jointed = true;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    check(fingers[i]);
    const PadFrame pad = pad_frame(fingers[i]);
    const Vector3 from = actions[i].point - pad.origin;
    places.push_back({dot(from, pad.y), dot(from, pad.z), {}, actions[i].torsion_radius});
    felt.segment<4>(static_cast<Eigen::Index>(4 * i)) << actions[i].normal, actions[i].tangential_y,
        actions[i].tangential_z, actions[i].torsion;
    jointed = jointed && joint_count(fingers[i]) > 0;
  }
  const SpaceMap map(fingers, places);
  const ContactColumns columns(places);
  const double size = map.spread() > 0.0 ? map.spread() : 1.0;
  Eigen::MatrixXd g = columns.of(map.wrench(map.middle()));
  g.bottomRows<3>() /= size;
  const Svd svd = singular_value_decomposition(g);
  const Eigen::Index rank = rank_of(svd.values);

  InternalForces result{.forces = static_cast<std::size_t>(columns.count()),
                        .rank = static_cast<std::size_t>(rank)};
  result.free = free_motions(svd.u.leftCols(rank), map);
  if (jointed) {
    Eigen::MatrixXd both(g.rows() + map.first_joint(map.contacts()), g.cols());
    Eigen::MatrixXd t = columns.of(map.torques());
    const double largest = t.cwiseAbs().maxCoeff();
    both << g, t / (largest > 0.0 ? largest : 1.0);
    const Eigen::VectorXd values = singular_values(both);
    result.without_torque = static_cast<std::size_t>(columns.count() - rank_of(values));
  }
  if (map.contacts() < 2 || map.contacts() > 4 || !map.has_spread()) return result;

  const Eigen::VectorXd forces = columns.forces(felt);
  const Eigen::MatrixXd v = svd.v.leftCols(rank);
  const Eigen::VectorXd internal = forces - v * (v.transpose() * forces);
  const Eigen::MatrixXd pushes = pushes_of_pairs(map, columns, result.pairs);
  const Eigen::VectorXd shares = pivoted_least_squares(pushes, internal);
  for (std::size_t i = 0; i < result.pairs.size(); ++i)
    result.pairs[i].push = shares(static_cast<Eigen::Index>(i));
  result.rest = (internal - pushes * shares).norm();
  return result;
}

}  // namespace tactile_net

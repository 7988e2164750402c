#include "tactile_net/grasp/space/measured_space_grasp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "grasp/chi_squared.hpp"
#include "grasp/space/space_map.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr Eigen::Index values = 6;  // of a contact, in the order of SpaceContactValue
constexpr Eigen::Index centre_y = 3;

/// The parameters are every finger's six values, in their order.
struct Parameters {
  Eigen::VectorXd felt;        ///< 4 contacts
  Eigen::MatrixXd felt_by;     ///< 4 contacts x parameters
  Eigen::MatrixXd covariance;  ///< of the parameters
};

Parameters parameters_of(std::span<const SpaceFingertipForce> forces) {
  const auto n = std::ssize(forces);
  Parameters p{Eigen::VectorXd(4 * n), Eigen::MatrixXd::Zero(4 * n, values * n),
               Eigen::MatrixXd::Zero(values * n, values * n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const SpaceFingertipForce& force = forces[static_cast<std::size_t>(i)];
    p.felt.segment<4>(4 * i) << force.normal, force.tangential_y, force.tangential_z, force.torsion;
    p.felt_by.block<3, 3>(4 * i, values * i).setIdentity();
    p.covariance.block<values, values>(values * i, values * i) =
        Eigen::Map<const Eigen::Matrix<double, values, values, Eigen::RowMajor>>(
            force.covariance.data());
    if (force.place.torsion_radius) p.felt_by(4 * i + 3, values * i + 5) = 1.0;
  }
  return p;
}

/// Sum of the components towards the middle, and what of the load the thesis takes off for f_g.
void add_squeeze(MeasuredSpaceGrasp& result, const SpaceMap& map, const Parameters& p,
                 const SpaceLoad& load) {
  if (map.contacts() < 2 || !map.has_spread()) return;
  Eigen::RowVectorXd gradient = map.squeeze() * p.felt_by;
  for (std::size_t i = 0; i < map.contacts(); ++i) {
    if (std::isnan(map.inward(i).x)) return;
    const PadFrame& pad = map.frame(i);
    const Eigen::Vector4d f = p.felt.segment<4>(static_cast<Eigen::Index>(4 * i));
    const Vector3 force = -(f(0) * pad.x + f(1) * pad.y + f(2) * pad.z);
    for (std::size_t k = 0; k < map.contacts(); ++k) {
      const Eigen::Index at = values * static_cast<Eigen::Index>(k) + centre_y;
      gradient(at) += dot(map.inward_change(i, k, map.frame(k).y), force);
      gradient(at + 1) += dot(map.inward_change(i, k, map.frame(k).z), force);
    }
  }
  const auto deviation = [&] {
    return std::sqrt(std::max((gradient * p.covariance).dot(gradient), 0.0));
  };
  result.squeeze = Uncertain{map.squeeze().dot(p.felt.transpose()), deviation()};
  if (map.contacts() != 2) return;
  const double pressed = dot(map.inward(0), load.force);
  for (std::size_t k = 0; k < 2; ++k) {
    Eigen::Index at = values * static_cast<Eigen::Index>(k) + centre_y;
    for (const Vector3 way : {map.frame(k).y, map.frame(k).z})
      gradient(at++) -= std::copysign(1.0, pressed) * dot(map.inward_change(0, k, way), load.force);
  }
  result.grasping_force = Uncertain{result.squeeze->value - std::abs(pressed), deviation()};
}

}  // namespace

MeasuredSpaceGrasp measured_grasp(std::span<const SpaceFinger> fingers,
                                  std::span<const SpaceFingertipForce> forces,
                                  const SpaceLoad& load) {
  if (fingers.empty()) throw std::invalid_argument("a hand has at least one finger");
  if (forces.size() != fingers.size())
    throw std::invalid_argument("there must be one fingertip force for each finger");
  if (!is_finite(load)) throw std::invalid_argument("the external load must be finite");
  std::vector<SpaceContactPlace> places;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    check(fingers[i], forces[i]);
    places.push_back(place_of(forces[i]));
  }
  const SpaceMap map(fingers, places);
  const Eigen::MatrixXd g = map.wrench(load.point);
  const Parameters p = parameters_of(forces);

  Eigen::MatrixXd torques_by = map.torques() * p.felt_by;
  Eigen::MatrixXd wrench_by = g * p.felt_by;
  double total = length(load.force);
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const Eigen::Vector4d f = p.felt.segment<4>(static_cast<Eigen::Index>(4 * i));
    total += f.head<3>().norm();
    const Eigen::Index first = map.first_joint(i);
    Eigen::Index at = values * static_cast<Eigen::Index>(i) + centre_y;
    for (const Vector3 way : {map.frame(i).y, map.frame(i).z}) {
      torques_by.col(at).segment(first, map.first_joint(i + 1) - first) +=
          map.torque_change(i, way) * f;
      wrench_by.col(at++) += map.wrench_change(i, way) * f;
    }
  }

  MeasuredSpaceGrasp result;
  result.fingers = map.actions(p.felt, p.felt_by, torques_by, p.covariance);
  result.torque_covariance = from_eigen(torques_by * p.covariance * torques_by.transpose());
  Eigen::VectorXd unbalanced = g * p.felt;
  unbalanced.head<3>() += column_of(load.force);
  unbalanced.tail<3>() += column_of(load.torque);
  const Eigen::MatrixXd c = wrench_by * p.covariance * wrench_by.transpose();
  for (std::size_t i = 0; i < 6; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.unbalanced[i] = {unbalanced(at), std::sqrt(std::max(c(at, at), 0.0))};
  }
  result.unbalanced_covariance = from_eigen(c);
  result.chi_squared = chi_squared(unbalanced, c);
  if (total > 0.0) result.unbalanced_share = unbalanced.head<3>().norm() / total;
  add_squeeze(result, map, p, load);
  return result;
}

}  // namespace tactile_net

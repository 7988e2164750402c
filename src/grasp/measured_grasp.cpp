#include "tactile_net/grasp/measured_grasp.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "grasp/chi_squared.hpp"
#include "grasp/grasp_map.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// Sum of the components towards the middle, and what of the load the thesis takes off for f_g.
void add_squeeze(MeasuredGrasp& result, const GraspMap& map, const Eigen::VectorXd& f,
                 const Eigen::MatrixXd& by_parameters, const Eigen::MatrixXd& covariance,
                 const ExternalLoad& load) {
  const std::size_t m = map.contacts();
  if (m < 2 || !map.has_spread()) return;
  double squeeze = 0.0;
  Eigen::RowVectorXd gradient = Eigen::RowVectorXd::Zero(covariance.cols());
  for (std::size_t i = 0; i < m; ++i) {
    const Vector2 e = map.inward(i);
    if (std::isnan(e.x)) return;
    const auto at = static_cast<Eigen::Index>(2 * i);
    squeeze += dot(e, force_of(f, i));
    gradient += e.x * by_parameters.row(at) + e.y * by_parameters.row(at + 1);
    for (std::size_t k = 0; k < m; ++k)
      gradient(static_cast<Eigen::Index>(3 * k + 2)) +=
          dot(map.inward_change(i, k), force_of(f, i));
  }
  const auto deviation = [&] {
    return std::sqrt(std::max((gradient * covariance).dot(gradient), 0.0));
  };
  result.squeeze = Uncertain{squeeze, deviation()};
  if (m != 2) return;
  const double pressed = dot(map.inward(0), load.force);
  for (std::size_t k = 0; k < m; ++k)
    gradient(static_cast<Eigen::Index>(3 * k + 2)) -=
        std::copysign(1.0, pressed) * dot(map.inward_change(0, k), load.force);
  result.grasping_force = Uncertain{squeeze - std::abs(pressed), deviation()};
}

}  // namespace

MeasuredGrasp measured_grasp(std::span<const Finger> fingers,
                             std::span<const FingertipForce> forces, const ExternalLoad& load) {
  if (fingers.empty()) throw std::invalid_argument("a hand has at least one finger");
  if (forces.size() != fingers.size())
    throw std::invalid_argument("there must be one fingertip force for each finger");
  if (!all_finite(load)) throw std::invalid_argument("the external load must be finite");
  const std::size_t m = fingers.size();
  std::vector<double> centres;
  for (std::size_t i = 0; i < m; ++i) {
    check(fingers[i], forces[i]);
    centres.push_back(forces[i].centre);
  }
  const GraspMap map(fingers, centres);
  const Eigen::MatrixXd t = map.torques();
  const Eigen::MatrixXd g = map.wrench(load.point);

  // The parameters are every finger's F_v, F_t and y*.
  const auto parameters = static_cast<Eigen::Index>(3 * m);
  Eigen::VectorXd f(g.cols());
  Eigen::MatrixXd by_parameters = Eigen::MatrixXd::Zero(g.cols(), parameters);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(parameters, parameters);
  double total = length(load.force);
  for (std::size_t i = 0; i < m; ++i) {
    const auto force = static_cast<Eigen::Index>(2 * i);
    const auto first = static_cast<Eigen::Index>(3 * i);
    const FingerPose& pose = map.pose(i);
    by_parameters.block<2, 2>(force, first) << -pose.inward.x, -pose.along.x, -pose.inward.y,
        -pose.along.y;
    f.segment<2>(force) = by_parameters.block<2, 2>(force, first) *
                          Eigen::Vector2d(forces[i].normal, forces[i].tangential);
    total += std::hypot(forces[i].normal, forces[i].tangential);
    covariance.block<3, 3>(first, first) =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
            forces[i].covariance.values.data());
  }
  Eigen::MatrixXd torques_by = t * by_parameters;
  Eigen::MatrixXd wrench_by = g * by_parameters;
  for (std::size_t i = 0; i < m; ++i) {
    const auto place = static_cast<Eigen::Index>(3 * i + 2);
    const double change = map.torque_change(i, force_of(f, i));
    const Eigen::Index joint = map.first_joint(i);
    torques_by.col(place).segment(joint, map.first_joint(i + 1) - joint).array() += change;
    wrench_by(2, place) += change;
  }

  MeasuredGrasp result;
  result.fingers = map.actions(f, by_parameters, torques_by, covariance);
  result.torque_covariance = from_eigen(torques_by * covariance * torques_by.transpose());
  const Eigen::Vector3d unbalanced =
      g * f + Eigen::Vector3d(load.force.x, load.force.y, load.torque);
  const Eigen::Matrix3d c = wrench_by * covariance * wrench_by.transpose();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.unbalanced[i] = {unbalanced(at), std::sqrt(std::max(c(at, at), 0.0))};
  }
  result.chi_squared = chi_squared(unbalanced, c);
  if (total > 0.0) result.unbalanced_share = std::hypot(unbalanced(0), unbalanced(1)) / total;
  add_squeeze(result, map, f, by_parameters, covariance, load);
  return result;
}

}  // namespace tactile_net

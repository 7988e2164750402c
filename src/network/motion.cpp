#include "tactile_net/network/motion.hpp"

#include <stdexcept>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {
namespace {

/// What the sources drive the same circuit's states with when its readings are these.
Eigen::VectorXd drive_of(const NetworkCircuit& circuit, std::span<const double> readings) {
  NetworkProblem problem = circuit.problem();
  const Eigen::VectorXd g = as_eigen(readings);
  const Eigen::VectorXd b = as_eigen(problem.kernel).transpose() * g;
  problem.readings.assign(readings.begin(), readings.end());
  problem.right_side.assign(b.begin(), b.end());
  const StateSpace system =
      state_space(FlatCircuit(realize(circuit.realization(), problem, circuit.options())));
  return as_eigen(std::span(system.drive));
}

}  // namespace

MotionLag motion_lag(const NetworkCircuit& circuit, std::span<const double> rate) {
  if (rate.size() != circuit.problem().readings.size())
    throw std::invalid_argument("a rate needs one value per reading");
  const StateSpace& system = circuit.state_space();
  const Eigen::MatrixXd a = as_eigen(system.dynamics);
  if (!(eigenvalues(a).real().maxCoeff() < 0.0))
    throw std::domain_error("an unstable circuit follows nothing");
  const Lu lu(a);
  const Eigen::MatrixXd c = as_eigen(system.output);
  const Eigen::VectorXd moved = lu.solve(drive_of(circuit, rate));
  const Eigen::VectorXd behind = lu.solve(moved);
  const std::vector<double> rest = steady_state(system);
  const double size = as_eigen(std::span(rest)).norm();
  if (!(size > 0.0)) throw std::domain_error("without an answer there is nothing to follow");
  const double lag = (c * behind).norm();
  const double change = (c * moved).norm();
  return {change > 0.0 ? lag / change : 0.0, lag / size};
}

}  // namespace tactile_net

#include "tactile_net/network/motion.hpp"

#include <stdexcept>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {
namespace {

/// The same circuit with these readings, driven by them alone.
StateSpace driven_by(const NetworkCircuit& circuit, std::span<const double> readings) {
  NetworkProblem problem = circuit.problem();
  const Eigen::VectorXd g = as_eigen(readings);
  const Eigen::VectorXd b = as_eigen(problem.kernel).transpose() * g;
  problem.readings.assign(readings.begin(), readings.end());
  problem.right_side.assign(b.begin(), b.end());
  RealizationOptions options = circuit.options();
  options.opamp.offset.reset();
  options.opamp.bias_current.reset();
  return state_space(FlatCircuit(realize(circuit.realization(), problem, options)));
}

}  // namespace

MotionLag motion_lag(const NetworkCircuit& circuit, std::span<const double> rate) {
  if (rate.size() != circuit.problem().readings.size())
    throw std::invalid_argument("a rate needs one value per reading");
  const StateSpace& system = circuit.state_space();
  if (!(circuit.poles().front().real() < 0.0))
    throw std::domain_error("an unstable circuit follows nothing");
  const Lu lu(as_eigen(system.dynamics));
  const Eigen::MatrixXd c = as_eigen(system.output);
  const StateSpace moving = driven_by(circuit, rate);
  const Eigen::VectorXd drive = as_eigen(std::span(moving.drive));
  const Eigen::VectorXd moved = lu.solve(drive);
  Eigen::VectorXd pushed = moved;  // voltages that rise push through capacitance too
  if (!moving.jump.empty()) pushed += as_eigen(std::span(moving.jump));
  const Eigen::VectorXd behind = lu.solve(pushed);
  const std::vector<double> rest = steady_state(system);
  const double size = as_eigen(std::span(rest)).norm();
  if (!(size > 0.0)) throw std::domain_error("without an answer there is nothing to follow");
  const double lag = (c * behind).norm();
  const double change = (as_eigen(std::span(moving.direct)) - c * moved).norm();
  return {change > 0.0 ? lag / change : 0.0, lag / size};
}

}  // namespace tactile_net

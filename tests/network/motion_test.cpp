#include "tactile_net/network/motion.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

NetworkCircuit network_circuit(Realization one, const NetworkProblem& problem) {
  return {one,
          std::make_shared<const NetworkProblem>(problem),
          {.opamp = {.gain = 1e9, .bandwidth = 1e7}}};
}

/// Neighbours' differences: how the readings change when the load moves by a pitch of 0.5.
std::vector<double> per_length(const NetworkProblem& problem) {
  const std::vector<double>& g = problem.readings;
  std::vector<double> rate(g.size());
  for (std::size_t i = 1; i + 1 < g.size(); ++i) rate[i] = -(g[i + 1] - g[i - 1]) / 1.0;
  return rate;
}

}  // namespace

TEST_CASE("the lag behind a ramp is what integrating it in time leaves", "[motion]") {
  const NetworkProblem problem = array_network(7, 1e-2).problem;
  const std::vector<double> rate = per_length(problem);
  for (const Realization one : {Realization::crossbar, Realization::lattice}) {
    CAPTURE(name(one));
    const NetworkCircuit circuit = network_circuit(one, problem);
    const MotionLag lag = motion_lag(circuit, rate);
    // x' = A x + b t, by Runge and Kutta's fourth order, until the transient is gone.
    const StateSpace& system = circuit.state_space();
    NetworkProblem moving = problem;
    moving.readings = rate;
    for (std::size_t j = 0; j < 7; ++j) {
      moving.right_side[j] = 0.0;
      for (std::size_t i = 0; i < 7; ++i) moving.right_side[j] += problem.kernel(i, j) * rate[i];
    }
    const std::vector<double> b = network_circuit(one, moving).state_space().drive;
    const std::vector<double> end = steady_state(network_circuit(one, moving).state_space());
    std::vector<double> x(system.states());
    const auto slope = [&](const std::vector<double>& at, double t) {
      std::vector<double> result(at.size());
      for (std::size_t i = 0; i < at.size(); ++i) {
        result[i] = b[i] * t;
        for (std::size_t j = 0; j < at.size(); ++j) result[i] += system.dynamics(i, j) * at[j];
      }
      return result;
    };
    const auto plus = [](std::vector<double> at, const std::vector<double>& by, double times) {
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += times * by[i];
      return at;
    };
    const double step = 1e-8;
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) {
      const double t = k * step;
      const auto k1 = slope(x, t);
      const auto k2 = slope(plus(x, k1, step / 2), t + step / 2);
      const auto k3 = slope(plus(x, k2, step / 2), t + step / 2);
      const auto k4 = slope(plus(x, k3, step), t + step);
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += step / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    double behind = 0.0;
    double moved = 0.0;
    for (std::size_t i = 0; i < 7; ++i) {
      double v = 0.0;
      for (std::size_t j = 0; j < x.size(); ++j) v += system.output(i, j) * x[j];
      behind += std::pow(end[i] * steps * step - v, 2);
      moved += end[i] * end[i];
    }
    CHECK_THAT(lag.seconds, WithinRel(std::sqrt(behind / moved), 1e-3));
  }
}

TEST_CASE("a moving load is followed to within a tenth of a microsecond", "[motion]") {
  const NetworkProblem problem = array_network(21, 1e-3).problem;
  const std::vector<double> rate = per_length(problem);
  // design: 0.109, 0.081 and 0.064 us for a cylinder of half width 2
  CHECK_THAT(motion_lag(network_circuit(Realization::crossbar, problem), rate).seconds,
             WithinRel(0.109e-6, 0.2));
  CHECK_THAT(motion_lag(network_circuit(Realization::lattice, problem), rate).seconds,
             WithinRel(0.081e-6, 0.2));
  CHECK_THAT(motion_lag(network_circuit(Realization::least_squares, problem), rate).seconds,
             WithinRel(0.064e-6, 0.2));
  CHECK_THROWS_AS(
      motion_lag(network_circuit(Realization::crossbar, problem), std::vector<double>(3)),
      std::invalid_argument);
}

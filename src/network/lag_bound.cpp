#include "network/lag_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

double radians(double hertz) { return 2.0 * std::numbers::pi * hertz; }

/// What the bound asks of the conductances alone.
struct Loop {
  double theta = 0.0;        ///< |D_e^-1/2 K D_f^-1/2|_2
  double gamma = 0.0;        ///< least feedback of a residual row over its total
  double least_total = 0.0;  ///< [S]
};

Loop loop_of(const NetworkCircuit& circuit) {
  const Reduction& reduction = circuit.reduction();
  const Equations equations = reduction.equations();
  const Eigen::MatrixXd s = as_eigen(equations.matrix);
  const Eigen::VectorXd total = as_eigen(std::span(equations.total));
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  const Eigen::Index rest = s.rows() - n;
  const Eigen::VectorXd units = total.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd coupling =
      units.tail(rest).asDiagonal() * s.bottomLeftCorner(rest, n) * units.head(n).asDiagonal();
  return {.theta = singular_values(coupling)(0),
          .gamma = s.diagonal().tail(rest).cwiseQuotient(total.tail(rest)).minCoeff(),
          .least_total = total.minCoeff()};
}

/// The largest W tau for which a W tau <= (1 - W tau / 4)^2, a = 4 theta^2 W_main / (gamma W).
double most_lag(double a) {
  // x^2 / 16 - (a + 1/2) x + 1 = 0, the smaller root without a difference of large numbers.
  const double half = 0.5 * (a + 0.5);
  return 1.0 / (half + std::sqrt(half * half - 1.0 / 16.0));
}

}  // namespace

LagBound lag_bound(const NetworkCircuit& circuit) {
  const RealizationOptions& options = circuit.options();
  const OpAmp& o = options.opamp;
  const double ratio = options.main_bandwidth(circuit.realization());
  const double main = ratio * radians(*o.bandwidth);
  const double fastest = std::max(1.0, ratio) * radians(*o.bandwidth);
  const Loop loop = loop_of(circuit);
  const double of_capacitance = o.input_capacitance.value_or(0.0) / loop.least_total;
  const double of_second_pole = o.second_pole ? 1.0 / radians(*o.second_pole) : 0.0;
  const double tau = of_capacitance + of_second_pole;

  const double a = 4.0 * loop.theta * loop.theta * main / (loop.gamma * fastest);
  const double lag = fastest * tau;
  const double left = 1.0 - 0.25 * lag;
  LagBound bound;
  bound.number = left > 0.0 ? a * lag / (left * left) : std::numeric_limits<double>::infinity();
  if (left > 0.0 && ratio <= 1.0) bound.bandwidth_ratio = ratio / bound.number;
  const double room = most_lag(a) / fastest - of_second_pole;
  if (room > 0.0) bound.siemens = options.scale.siemens * of_capacitance / room;
  return bound;
}

}  // namespace tactile_net

#include "network/lag_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "network/amplifier_equations.hpp"
#include "network/angular_frequency.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// What the bound asks of the conductances alone.
struct Loop {
  double theta = 0.0;        ///< |D_e^-1/2 K A^1/2 D_f^-1/2|_2, A = 1 without a ladder
  double gamma = 0.0;        ///< least feedback of a residual row over its total
  double least_total = 0.0;  ///< [S]
  double node_delay = 0.0;   ///< of a ladder's nodes, over their capacitance [ohm]
};

/// The nodes of a ladder feel the residuals' inputs: D_e is a matrix, between the feedbacks alone
/// and the rows' totals. K A^1/2 (K A^1/2)' is the loop's gain from e to y and back.
Loop loop_with_ladder(const AmplifierEquations& own, Eigen::Index n) {
  const Eigen::Index rest = own.stiffness.rows() - n;
  const Eigen::VectorXd main = own.inertia.diagonal().head(n);
  const Eigen::MatrixXd residual = own.inertia.bottomRightCorner(rest, rest);
  const Lu totals(residual);
  const Eigen::VectorXd units = own.stiffness.diagonal().tail(rest).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd around = own.stiffness.bottomLeftCorner(rest, n) *
                                 main.cwiseInverse().asDiagonal() *
                                 -own.stiffness.topRightCorner(n, rest);
  const Eigen::VectorXd over_feedback =
      symmetric_eigenvalues(units.asDiagonal() * residual * units.asDiagonal());
  // Capacitance c at the nodes: f = (G + p c)^-1 ..., and D_e grows by p c into_rows G^-2
  // from_inputs.
  const Eigen::MatrixXd nodes = Lu(own.followers).inverse();
  const Eigen::MatrixXd delayed =
      own.into_rows.bottomRows(rest) * nodes * nodes * own.from_inputs.rightCols(rest);
  return {.theta = std::sqrt(eigenvalues(totals.solve(around)).real().maxCoeff()),
          .gamma = 1.0 / over_feedback(rest - 1),
          .least_total = std::min(main.minCoeff(), symmetric_eigenvalues(residual)(0)),
          .node_delay = std::max(1.0 / symmetric_eigenvalues(own.followers)(0),
                                 eigenvalues(totals.solve(delayed)).real().maxCoeff())};
}

Loop loop_of(const NetworkCircuit& circuit) {
  const Reduction& reduction = circuit.reduction();
  const Equations equations = reduction.equations();
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  if (has_ladder(circuit.realization(), circuit.options()))
    return loop_with_ladder(amplifier_equations(reduction, equations), n);
  const Eigen::MatrixXd s = as_eigen(equations.matrix);
  const Eigen::VectorXd total = as_eigen(std::span(equations.total));
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

namespace {

/// Capacitance at a ladder's nodes, and no other lag.
LagBound bound_of_nodes(const NetworkCircuit& circuit) {
  const RealizationOptions& options = circuit.options();
  const double ratio = options.main_bandwidth(circuit.realization());
  const double main = ratio * angular_frequency(*options.opamp.bandwidth);
  const Loop loop = loop_of(circuit);
  LagBound bound{.of_nodes = true};
  bound.number = 4.0 * loop.theta * loop.theta * main * *options.node_capacitance *
                 loop.node_delay / loop.gamma;
  bound.siemens = options.scale.siemens * bound.number;
  bound.bandwidth_ratio = ratio / bound.number;
  return bound;
}

}  // namespace

LagBound lag_bound(const NetworkCircuit& circuit) {
  const RealizationOptions& options = circuit.options();
  const OpAmp& o = options.opamp;
  if (has_ladder(circuit.realization(), options) && options.node_capacitance)
    return bound_of_nodes(circuit);
  const double ratio = options.main_bandwidth(circuit.realization());
  const double main = ratio * angular_frequency(*o.bandwidth);
  // Of finite gain A a row's lag counts (1 + 1/A) times as much.
  const double fastest =
      (1.0 + 1.0 / o.dc_gain()) * std::max(1.0, ratio) * angular_frequency(*o.bandwidth);
  const Loop loop = loop_of(circuit);
  // Every '+' is grounded here, so what lies between the inputs lies at the summing node.
  const double of_capacitance =
      (o.input_capacitance.value_or(0.0) + o.differential_capacitance.value_or(0.0)) /
      loop.least_total;
  const double of_second_pole = o.second_pole ? 1.0 / angular_frequency(*o.second_pole) : 0.0;
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

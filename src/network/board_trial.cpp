// Boards that are not built: what a bench would measure of them, and what they would say of
// themselves.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "network/nodal_equations.hpp"
#include "network/random.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/robust.hpp"
#include "tactile_net/network/board_bench.hpp"
#include "tactile_net/network/tolerance.hpp"

namespace tactile_net {

BoardResponses simulated_responses(const FlatCircuit& circuit, std::span<const BoardInput> inputs,
                                   std::span<const double> siemens, const Matrix& currents,
                                   int bits, double volts, std::uint64_t seed) {
  Circuit built = perturbed(circuit, siemens);
  for (AmplifierModel& model : built.amplifiers)
    model.opamp.offset.reset();  // measured at rest, and subtracted
  const FlatCircuit flat(built);
  const NodalEquations equations(flat);
  const double step = std::ldexp(volts, 1 - bits);
  BoardResponses result{.currents = currents, .noise = step / std::sqrt(12.0)};
  const std::size_t outputs = built.outputs.size();
  result.voltages = {currents.rows, outputs, std::vector<double>(currents.rows * outputs)};
  for (std::size_t m = 0; m < currents.rows; ++m) {
    std::vector<CurrentSource> driven;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      for (CurrentSource one : inputs[i].per_ampere) {
        one.ampere *= currents(m, i);
        driven.push_back(one);
      }
    const Eigen::VectorXd v = equations.outputs(driven);
    for (std::size_t n = 0; n < outputs; ++n) {
      // Where within a step the converter's threshold lies is not known.
      const double dither = 0.5 * uniform(seed, m, n);
      const double code = std::round(v(eigen_index(n)) / step + dither) - dither;
      const double seen = code * step;
      result.voltages(m, n) =
          std::abs(seen) < volts ? seen : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return result;
}

SelfTest self_test(const Reduction& reduction, const Matrix& matrix,
                   std::span<const double> right_side, std::span<const double> tolerances,
                   std::size_t builds, std::uint64_t seed) {
  const auto p = as_eigen(matrix);
  const auto b = as_eigen(right_side);
  const Eigen::Index n = eigen_index(reduction.outputs());
  Equations equations;
  struct Solved {
    Eigen::VectorXd answer;       // under the readings
    Eigen::MatrixXd by_currents;  // outputs by currents into the amplifiers' rows
  };
  const auto solve = [&](std::span<const double> siemens) {
    reduction.assemble(siemens, equations);
    const Eigen::MatrixXd inverse = Lu(as_eigen(equations.matrix)).inverse();
    return Solved{inverse.topRows(n) * as_eigen(std::span(equations.right_side)),
                  inverse.topLeftCorner(n, n)};
  };
  const Solved exact = solve(reduction.siemens());
  const Eigen::VectorXd direct = solve_definite(p, b);
  if (!exact.answer.allFinite() || !(direct.norm() > 0.0))
    throw std::domain_error("without an answer there is nothing to test");
  // Volts per unit of f, and the network's answer to r at the rows in those volts: both by the
  // exact board.
  const double volts = exact.answer.dot(direct) / direct.squaredNorm();
  const Eigen::MatrixXd unit = exact.by_currents * p;  // a multiple of the unit matrix
  const double scale = 1.0 / unit.diagonal().mean();

  std::vector<double> shown;
  std::vector<double> apart;
  for (std::size_t k = 0; k < builds; ++k) {
    std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
    for (std::size_t r = 0; r < siemens.size(); ++r)
      siemens[r] /= 1.0 + tolerances[r] * uniform(seed, k, r);
    const Solved board = solve(siemens);
    const Eigen::VectorXd f = board.answer / volts;
    const Eigen::VectorXd residual = b - p * f;
    const Eigen::VectorXd d = scale * (board.by_currents * residual);
    const double length = d.dot(p * d);
    const double w = length > 0.0 ? residual.dot(d) / length : 0.0;
    const double seen = (w * d).norm() / f.norm();
    const double own = (f - direct).norm() / f.norm();
    if (!std::isfinite(seen)) {
      shown.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    shown.push_back(seen);
    if (own > 0.0) apart.push_back(std::abs(seen / own - 1.0));
  }
  return {.limit = quantile(shown, 0.95),
          .median = quantile(shown, 0.5),
          .apart = quantile(apart, 0.95)};
}

}  // namespace tactile_net

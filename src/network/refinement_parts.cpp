#include "network/refinement_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "network/draw_stability.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

void check_circuit(const NetworkCircuit& circuit) {
  const Realization realization = circuit.realization();
  const bool covered = traits(realization).drives_nodes && !circuit.options().inverters &&
                       !has_ladder(realization, circuit.options());
  if (!covered)
    throw std::invalid_argument(
        "refinement is of crossbar, least_squares and lattice, with complementary outputs and "
        "without a ladder: realization = \"lattice\"");
}

/// Bounded errors, each resistor's own.
void check_tolerances(const ToleranceOptions& options) {
  if (options.common.any() || options.balance || options.cell_noise || options.wire_resistance)
    throw std::invalid_argument(
        "refinement takes parts whose errors are bounded and each its own: leave out reel, "
        "measured, temperature, balance, cell_noise and wire_resistance, and state relative, "
        "stabiliser, series or bits");
}

/// What is drawn about: the same tolerances without errors.
std::vector<double> printed_siemens(const Reduction& reduction, ToleranceOptions options) {
  if (!options.series && !options.bits)
    return {reduction.siemens().begin(), reduction.siemens().end()};
  options.relative.reset();
  options.stabiliser.reset();
  options.each.clear();
  return drawn(reduction, options, 0);
}

/// By how much each build may differ from those: of every resistor, as `drawn` draws it.
std::vector<double> tolerance_of_each(const Reduction& reduction, const ToleranceOptions& options) {
  ToleranceOptions plain = options;
  plain.bits.reset();
  std::vector<double> all = options.each;
  if (all.empty())
    for (const std::string& resistor : reduction.resistors())
      all.push_back(options.stabiliser && resistor.starts_with("Rs")
                        ? *options.stabiliser
                        : options.relative.value_or(0.0));
  if (!options.bits) return all;
  // Cells that are programmed have no error of their own: they are where a draw does not move.
  std::vector<double> moved = drawn(reduction, options, 0);
  const std::vector<double> still = printed_siemens(reduction, options);
  for (std::size_t r = 0; r < all.size(); ++r)
    if (moved[r] == still[r]) all[r] = 0.0;
  return all;
}

/// A root of a symmetric R that is not negative: its Cholesky factor's part, without P.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& r) {
  const Svd svd = singular_value_decomposition(r);
  return svd.values.cwiseSqrt().asDiagonal() * svd.u.transpose();
}

}  // namespace

Refinement::Parts::Parts(const NetworkCircuit& of, ToleranceOptions among,
                         const RefinementOptions& wanted)
    : circuit((check_circuit(of), of)),
      reduction(of.reduction()),
      tolerances((check_tolerances(among), std::move(among))),
      options((check(wanted), wanted)),
      printed(printed_siemens(reduction, tolerances)),
      within(tolerance_of_each(reduction, tolerances)) {
  for (std::size_t r = 0; r < reduction.resistors().size(); ++r)
    branches.push_back(reduction.branch(r));
  const NetworkProblem& problem = circuit.problem();
  sizes.outputs = eigen_index(reduction.outputs());
  sizes.common = traits(circuit.realization()).passive_residuals ? sizes.outputs : 0;
  sizes.residuals = eigen_index(reduction.rows()) - sizes.outputs - sizes.common;
  const OpAmp& opamp = circuit.options().opamp;
  if (!opamp.is_nullor()) lossy = 1.0 / opamp.dc_gain();
  kernel = as_eigen(problem.kernel);
  stabiliser = as_eigen(problem.stabiliser);
  exact = as_eigen(problem.matrix);
  readings = as_eigen(std::span(problem.readings));

  Eigen::MatrixXd stacked(kernel.rows() + kernel.cols(), kernel.cols());
  stacked << kernel, root_of(stabiliser);
  const Svd svd = long_singular_value_decomposition(stacked);
  const Eigen::Index n = kernel.cols();
  least = std::pow(svd.values(n - 1), 2);
  largest = std::pow(svd.values(0), 2);
  if (!(least > 0.0)) throw std::invalid_argument("P is singular: refinement has no end");
  root = svd.v * svd.values.asDiagonal() * svd.v.transpose();
  inverse_root = svd.v * svd.values.cwiseInverse().asDiagonal() * svd.v.transpose();
  const Eigen::VectorXd along = svd.u.topRows(kernel.rows()).transpose() * readings;
  direct = svd.v * along.cwiseQuotient(svd.values);
  if (!(direct.norm() > 0.0))
    throw std::invalid_argument("without a load there is nothing to refine: give a contact");

  // An exact circuit without losses sees a multiple of P.
  const SeenMatrix ideal(reduction, reduction.equations(), sizes, 0.0);
  unit = ideal.matrix().diagonal().sum() / exact.diagonal().sum();
  volts = circuit.options().scale.volts;
  range = volts * direct.cwiseAbs().maxCoeff();
  const std::vector<std::vector<CurrentSource>> own = {circuit.circuit().sources};
  opamps = opamp_errors(circuit.flat(), own);
}

SeenMatrix Refinement::Parts::seen(std::span<const double> siemens) const {
  Equations equations;
  reduction.assemble(siemens, equations);
  return {reduction, equations, sizes, lossy};
}

SeenBuild Refinement::Parts::built(std::span<const double> siemens) const {
  Equations equations;
  reduction.assemble(siemens, equations);
  const SeenMatrix all(reduction, equations, sizes, lossy);
  SeenBuild build;
  build.stable = is_stable(reduction, equations);
  build.matrix = all.matrix() / unit;
  build.inverse = Lu(build.matrix).inverse();
  build.answer = build.inverse * all.driven() / (unit * volts);
  return build;
}

LargestSingular largest_singular(const Eigen::MatrixXd& a) {
  LargestSingular found;
  if (a.size() == 0 || !a.allFinite()) return found;
  const Svd svd = singular_value_decomposition(a);
  return {svd.values(0), svd.u.col(0), svd.v.col(0)};
}

}  // namespace tactile_net

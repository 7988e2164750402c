#include "tactile_net/network/realization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inverse/stabiliser.hpp"
#include "numeric/eigen.hpp"
#include "numeric/named.hpp"

namespace tactile_net {

namespace {

/// Entries below the rounding of the largest, or below what the matrix is known to, are zero: they
/// say nothing, and would be resistors beyond any other.
void drop_rounding(Matrix& matrix, double known_to) {
  double largest = 0.0;
  for (const double value : matrix.values) largest = std::max(largest, std::abs(value));
  const double floor = std::max(0.5 * std::numeric_limits<double>::epsilon() * largest, known_to);
  for (double& value : matrix.values)
    if (std::abs(value) <= floor) value = 0.0;
}

constexpr Named<Realization> names[] = {{Realization::ideal, "ideal"},
                                        {Realization::nic, "nic"},
                                        {Realization::rail, "rail"},
                                        {Realization::crossbar, "crossbar"},
                                        {Realization::least_squares, "least_squares"},
                                        {Realization::lc, "lc"},
                                        {Realization::ndr, "ndr"}};
static_assert(realizations.size() == std::size(names));

}  // namespace

std::string_view name(Realization realization) noexcept { return name_in<names>(realization); }

std::optional<Realization> realization_named(std::string_view text) noexcept {
  return named_in<names>(text);
}

bool has_amplifiers(Realization realization) noexcept {
  return realization == Realization::nic || realization == Realization::rail ||
         realization == Realization::crossbar || realization == Realization::least_squares;
}

NetworkProblem network_problem(const InverseProblem& problem, double alpha,
                               std::span<const double> readings) {
  NetworkProblem result{.matrix = normal_matrix(problem, alpha),
                        .right_side = normal_right_side(problem, readings),
                        .kernel = problem.kernel,
                        .stabiliser = {},
                        .readings = {readings.begin(), readings.end()}};
  drop_rounding(result.matrix, 0.0);
  const auto entries = static_cast<double>(problem.kernel.values.size());
  drop_rounding(result.kernel, problem.kernel_error / std::sqrt(entries));
  const Eigen::MatrixXd l = stabiliser(problem);
  result.stabiliser = from_eigen(alpha * (l.transpose() * l));
  for (std::size_t i = 0; i < result.readings.size(); ++i) result.readings[i] *= problem.weights[i];
  return result;
}

double RealizationOptions::main_bandwidth(Realization realization) const noexcept {
  if (bandwidth_ratio) return *bandwidth_ratio;
  if (!inverters) return 1.0;
  return realization == Realization::crossbar ? 0.5 : 0.2 / residual_gain;
}

bool takes_time(Realization realization, const RealizationOptions& options) noexcept {
  if (has_amplifiers(realization)) return options.opamp.bandwidth.has_value();
  return realization != Realization::lc && options.node_capacitance.has_value();
}

void check(const RealizationOptions& options) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw std::invalid_argument(std::string(name) + " must be > 0 and finite");
  };
  positive(options.scale.siemens, "siemens");
  positive(options.scale.volts, "volts");
  positive(options.residual_gain, "residual_gain");
  positive(options.bandwidth_ratio.value_or(1.0), "bandwidth_ratio");
  positive(options.divider, "divider");
  positive(options.node_capacitance.value_or(1.0), "a node's capacitance");
  positive(options.frequency, "frequency");
  positive(options.device_volts, "a device's volts");
  check(options.opamp);
}

Circuit realize(Realization realization, const NetworkProblem& problem,
                const RealizationOptions& options) {
  if (realization == Realization::crossbar)
    return crossbar(problem.matrix, problem.right_side, options);
  if (realization == Realization::least_squares) return least_squares(problem, options);
  const ConductanceNetwork network = conductances(problem.matrix);
  const auto build = realization == Realization::nic    ? nic
                     : realization == Realization::rail ? rail
                     : realization == Realization::lc   ? lc
                     : realization == Realization::ndr  ? ndr
                                                        : ideal;
  return build(network, problem.right_side, options);
}

}  // namespace tactile_net

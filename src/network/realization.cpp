#include "tactile_net/network/realization.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "network/rounding.hpp"
#include "tactile_net/inverse/stabiliser.hpp"

namespace tactile_net {

NetworkProblem network_problem(const LinearProblem& problem, double alpha,
                               std::span<const double> readings) {
  NetworkProblem result{.matrix = normal_matrix(problem, alpha),
                        .right_side = normal_right_side(problem, readings),
                        .kernel = problem.kernel,
                        .stabiliser = stabiliser_matrix(problem, alpha),
                        .readings = weighted(problem, readings)};
  drop_rounding(result.matrix, 0.0);
  const auto entries = static_cast<double>(problem.kernel.values.size());
  drop_rounding(result.kernel, problem.kernel_error / std::sqrt(entries));
  return result;
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
  positive(options.resistor_capacitance.value_or(1.0), "a resistor's capacitance");
  positive(options.frequency, "frequency");
  positive(options.device_volts, "a device's volts");
  check(options.opamp);
}

}  // namespace tactile_net

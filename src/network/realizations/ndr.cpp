/// @file
/// As `ideal`, with an N-shaped device for every negative conductance. The answer errs as the
/// square of node voltages over `device_volts`.
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"

namespace tactile_net {
namespace {

Circuit ndr_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  const ConductanceNetwork network = conductances(problem.matrix);
  Circuit circuit = driven_nodes(network, problem.right_side, options);
  const auto add = [&](const std::string& name, Node from, Node to, double siemens) {
    if (siemens > 0.0)
      circuit.resistors.push_back({"R" + name, from, to, siemens});
    else if (siemens < 0.0)
      circuit.devices.push_back(
          {"B" + name, from, to, -siemens, options.device_volts, options.curve});
  };
  each_conductance(network, circuit, options.scale.siemens, add);
  return circuit;
}

constexpr TheoremCondition ndr_conditions[] = {TheoremCondition::definite};

}  // namespace

constexpr RealizationTraits ndr_traits{
    .realization = Realization::ndr,
    .parts = RealizationTraits::Parts::curved,
    .theorem = {"convex",
                "A slope that is nowhere below -g leaves the potential strictly convex: one "
                "operating point, approached from everywhere, if P is positive definite.",
                ndr_conditions},
    .build = ndr_circuit};

}  // namespace tactile_net

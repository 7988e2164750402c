/// @file
/// As `ideal`, with every negative branch built from two op-amps (`floating_nic`) and every
/// negative ground conductance from one (`grounded_nic`). The '+' input of each op-amp is at the
/// network's node: with the inputs swapped the operating point is the same and the circuit is
/// unstable.
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"

namespace tactile_net {
namespace {

/// -G between two nodes: a converter and one resistor 1/G at each of its outputs.
void add_negative_branch(Circuit& circuit, const Branch& branch, double siemens) {
  const std::string name = branch_name(branch);
  const Node a = circuit.outputs[branch.from];
  const Node b = circuit.outputs[branch.to];
  const Node out_a = add_node(circuit, "a" + name);
  const Node out_b = add_node(circuit, "b" + name);
  circuit.instances.push_back({"Xf" + name, {a, b, out_a, out_b}, "floating_nic"});
  circuit.resistors.push_back({"Ra" + name, a, out_a, siemens});
  circuit.resistors.push_back({"Rb" + name, b, out_b, siemens});
}

Circuit nic_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  const ConductanceNetwork network = conductances(problem.matrix);
  Circuit circuit = driven_nodes(network, problem.right_side, options);
  circuit.amplifiers.push_back({"opamp", options.opamp, Outputs::single});
  for (const Branch& branch : network.branches) {
    const double siemens = options.scale.siemens * branch.conductance;
    if (siemens < 0.0)
      add_negative_branch(circuit, branch, -siemens);
    else
      circuit.resistors.push_back({"R" + branch_name(branch), circuit.outputs[branch.from],
                                   circuit.outputs[branch.to], siemens});
  }
  for (std::size_t i = 0; i < network.nodes; ++i)
    add_ground(circuit, i, options.scale.siemens * network.ground[i]);
  return circuit;
}

constexpr TheoremCondition nic_conditions[] = {
    TheoremCondition::definite, TheoremCondition::divider_fast_enough,
    TheoremCondition::no_resistor_capacitance, TheoremCondition::no_output_resistance,
    TheoremCondition::no_common_mode_error};

}  // namespace

constexpr RealizationTraits nic_traits{
    .realization = Realization::nic,
    .uses_opamps = true,
    .opamps_per_branch = true,
    .theorem = {"T1",
                "Converters with '+' at the network's nodes: stable for any node capacitance, any "
                "bandwidths and any second poles if P is positive definite (at infinite gain "
                "only then); with one pole for any capacitance at inverting inputs up to "
                "1/(W r (1 + sqrt(1 + 1/A))) too, A the gain.",
                nic_conditions},
    .build = nic_circuit};

}  // namespace tactile_net

/// @file
/// An inverter per node gives the rail r_j = -v_j: a negative branch is a resistor from each of its
/// nodes to the other's rail. That leaves P_ii - sum |P_ij| to ground, with what the inverter loads
/// the node with taken off: a grounded converter where it is negative. Two op-amps a node.
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"

namespace tactile_net {
namespace {

Circuit rail_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  const ConductanceNetwork network = conductances(problem.matrix);
  Circuit circuit = driven_nodes(network, problem.right_side, options);
  circuit.amplifiers.push_back({"opamp", options.opamp, Outputs::single});

  // A resistor from n_i to r_j = -v_j carries |g| (v_i + v_j): -|g| (v_i - v_j) as it should, and
  // 2 |g| v_i too much.
  std::vector<double> ground(network.ground);
  std::vector<bool> inverted(network.nodes);
  for (const Branch& branch : network.branches)
    if (branch.conductance < 0.0)
      for (const std::size_t i : {branch.from, branch.to}) {
        ground[i] += 2.0 * branch.conductance;
        inverted[i] = true;
      }
  std::vector<Node> rails(network.nodes);
  for (std::size_t i = 0; i < network.nodes; ++i)
    if (inverted[i]) {
      const std::string index = std::to_string(i);
      rails[i] = add_node(circuit, "r" + index);
      circuit.instances.push_back({"Xr" + index, {circuit.outputs[i], rails[i]}, "inverter"});
    }

  const double siemens = options.scale.siemens;
  for (const Branch& branch : network.branches) {
    const std::string name = branch_name(branch);
    const Node a = circuit.outputs[branch.from];
    const Node b = circuit.outputs[branch.to];
    if (branch.conductance > 0.0) {
      circuit.resistors.push_back({"R" + name, a, b, siemens * branch.conductance});
    } else {
      circuit.resistors.push_back(
          {"Ra" + name, a, rails[branch.to], -siemens * branch.conductance});
      circuit.resistors.push_back(
          {"Rb" + name, b, rails[branch.from], -siemens * branch.conductance});
    }
  }
  for (std::size_t i = 0; i < network.nodes; ++i)
    add_ground(circuit, i, siemens * ground[i] - (inverted[i] ? 1.0 / options.divider : 0.0));
  return circuit;
}

constexpr TheoremCondition rail_conditions[] = {TheoremCondition::definite,
                                                TheoremCondition::no_input_capacitance,
                                                TheoremCondition::no_second_pole,
                                                TheoremCondition::no_resistor_capacitance,
                                                TheoremCondition::no_output_resistance,
                                                TheoremCondition::no_common_mode_error};

}  // namespace

constexpr RealizationTraits rail_traits{
    .realization = Realization::rail,
    .uses_opamps = true,
    .theorem = {"T2",
                "Op-amps of equal bandwidth and gain: stable for any node capacitance if P is "
                "positive definite; at infinite gain only then.",
                rail_conditions},
    .build = rail_circuit};

}  // namespace tactile_net

#include "network/nodes.hpp"

namespace tactile_net {

Circuit rail(const ConductanceNetwork& network, std::span<const double> right_side,
             const RealizationOptions& options) {
  Circuit circuit = driven_nodes(network, right_side, options);
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

}  // namespace tactile_net

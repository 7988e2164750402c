#include <numbers>

#include "network/nodes.hpp"

namespace tactile_net {

Circuit lc(const ConductanceNetwork& network, std::span<const double> right_side,
           const RealizationOptions& options) {
  RealizationOptions at_one_frequency = options;
  at_one_frequency.node_capacitance.reset();  // it would be one more conductance
  Circuit circuit = driven_nodes(network, right_side, at_one_frequency);
  const double w = 2.0 * std::numbers::pi * options.frequency;
  const auto add = [&](const std::string& name, Node from, Node to, double siemens) {
    if (siemens > 0.0)
      circuit.capacitors.push_back({"C" + name, from, to, siemens / w});
    else if (siemens < 0.0)
      circuit.inductors.push_back({"L" + name, from, to, -1.0 / (w * siemens)});
  };
  for (const Branch& branch : network.branches)
    add(branch_name(branch), circuit.outputs[branch.from], circuit.outputs[branch.to],
        options.scale.siemens * branch.conductance);
  for (std::size_t i = 0; i < network.nodes; ++i)
    add("g" + std::to_string(i), circuit.outputs[i], 0, options.scale.siemens * network.ground[i]);
  return circuit;
}

}  // namespace tactile_net

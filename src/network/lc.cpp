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
  each_conductance(network, circuit, options.scale.siemens, add);
  return circuit;
}

}  // namespace tactile_net

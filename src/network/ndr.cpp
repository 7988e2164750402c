#include "network/nodes.hpp"

namespace tactile_net {

Circuit ndr(const ConductanceNetwork& network, std::span<const double> right_side,
            const RealizationOptions& options) {
  Circuit circuit = driven_nodes(network, right_side, options);
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

}  // namespace tactile_net

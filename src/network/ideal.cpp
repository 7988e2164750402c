#include "network/nodes.hpp"

namespace tactile_net {

Circuit ideal(const ConductanceNetwork& network, std::span<const double> right_side,
              const RealizationOptions& options) {
  Circuit circuit = driven_nodes(network, right_side, options);
  const double siemens = options.scale.siemens;
  for (const Branch& branch : network.branches)
    circuit.resistors.push_back({"R" + branch_name(branch), circuit.outputs[branch.from],
                                 circuit.outputs[branch.to], siemens * branch.conductance});
  for (std::size_t i = 0; i < network.nodes; ++i)
    if (network.ground[i] != 0.0)
      circuit.resistors.push_back(
          {"Rg" + std::to_string(i), circuit.outputs[i], 0, siemens * network.ground[i]});
  return circuit;
}

}  // namespace tactile_net

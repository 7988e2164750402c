#include "network/nodes.hpp"
#include "tactile_net/network/realization.hpp"

namespace tactile_net {

Circuit ideal(const ConductanceNetwork& network, std::span<const double> right_side,
              const Scale& scale) {
  Circuit circuit = driven_nodes(network, right_side, scale);
  for (const Branch& branch : network.branches)
    circuit.resistors.push_back({"R" + branch_name(branch), circuit.outputs[branch.from],
                                 circuit.outputs[branch.to], scale.siemens * branch.conductance});
  for (std::size_t i = 0; i < network.nodes; ++i)
    if (network.ground[i] != 0.0)
      circuit.resistors.push_back(
          {"Rg" + std::to_string(i), circuit.outputs[i], 0, scale.siemens * network.ground[i]});
  return circuit;
}

}  // namespace tactile_net

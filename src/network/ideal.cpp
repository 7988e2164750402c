#include "network/nodes.hpp"

namespace tactile_net {

Circuit ideal(const ConductanceNetwork& network, std::span<const double> right_side,
              const RealizationOptions& options) {
  Circuit circuit = driven_nodes(network, right_side, options);
  each_conductance(network, circuit, options.scale.siemens,
                   [&](const std::string& name, Node from, Node to, double siemens) {
                     circuit.resistors.push_back({"R" + name, from, to, siemens});
                   });
  return circuit;
}

}  // namespace tactile_net

/// @file
/// What every realisation begins with: one node and one source per unknown. Private.
#pragma once

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "inverse/finite.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/conductances.hpp"

namespace tactile_net {

/// Nodes n0, n1, ... (indices 1, 2, ...) with the current sources I0, I1, ...
/// @throw std::invalid_argument  sizes differ, a value is not finite, or the scale is not > 0
[[nodiscard]] inline Circuit driven_nodes(const ConductanceNetwork& network,
                                          std::span<const double> right_side, const Scale& scale) {
  if (right_side.size() != network.nodes || network.ground.size() != network.nodes)
    throw std::invalid_argument("the network needs one current and one ground value per node");
  if (!all_finite(right_side)) throw std::invalid_argument("the currents must be finite");
  if (!(scale.siemens > 0.0) || !std::isfinite(scale.siemens))
    throw std::invalid_argument("siemens must be > 0 and finite");
  if (!(scale.volts > 0.0) || !std::isfinite(scale.volts))
    throw std::invalid_argument("volts must be > 0 and finite");

  Circuit circuit;
  for (std::size_t i = 0; i < network.nodes; ++i) {
    const std::string index = std::to_string(i);
    circuit.outputs.push_back(add_node(circuit, "n" + index));
    circuit.sources.push_back(
        {"I" + index, circuit.outputs[i], scale.siemens * scale.volts * right_side[i]});
  }
  circuit.resistors.reserve(network.branches.size() + network.nodes);
  return circuit;
}

[[nodiscard]] inline std::string branch_name(const Branch& branch) {
  return std::to_string(branch.from) + "_" + std::to_string(branch.to);
}

}  // namespace tactile_net

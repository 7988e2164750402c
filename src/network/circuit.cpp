#include "tactile_net/network/circuit.hpp"

#include <algorithm>

namespace tactile_net {
Node add_node(Circuit& circuit, std::string name) {
  circuit.nodes.push_back(std::move(name));
  return circuit.nodes.size() - 1;
}

std::vector<bool> held_nodes(const Circuit& circuit) {
  std::vector<bool> held(circuit.nodes.size());
  for (const CurrentSource& one : circuit.sources)
    if (one.volts) held[one.into] = true;
  return held;
}

std::vector<std::string> output_names(const Circuit& circuit) {
  std::vector<std::string> names;
  for (const Node node : circuit.outputs) names.push_back(circuit.nodes[node]);
  return names;
}

const AmplifierModel* amplifier(const Circuit& circuit, std::string_view name) {
  const auto found = std::find_if(circuit.amplifiers.begin(), circuit.amplifiers.end(),
                                  [&](const AmplifierModel& model) { return model.name == name; });
  return found == circuit.amplifiers.end() ? nullptr : &*found;
}

}  // namespace tactile_net

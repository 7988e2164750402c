#include "tactile_net/network/circuit.hpp"

#include <algorithm>

#include "tactile_net/network/subcircuits.hpp"

namespace tactile_net {

Node add_node(Circuit& circuit, std::string name) {
  circuit.nodes.push_back(std::move(name));
  return circuit.nodes.size() - 1;
}

ElementCounts count_elements(const Circuit& circuit) {
  ElementCounts counts{.resistors = circuit.resistors.size(), .sources = circuit.sources.size()};
  counts.negative_resistors = static_cast<std::size_t>(
      std::count_if(circuit.resistors.begin(), circuit.resistors.end(),
                    [](const Resistor& resistor) { return resistor.siemens < 0.0; }));
  for (const Instance& instance : circuit.instances) {
    const Subcircuit& inside = subcircuit(instance.subcircuit);
    counts.opamps += inside.opamps;
    counts.resistors += inside.resistors;
  }
  return counts;
}

}  // namespace tactile_net

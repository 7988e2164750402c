#include "tactile_net/network/circuit.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tactile_net/network/subcircuits.hpp"

namespace tactile_net {
namespace {

/// Puts the elements of a sub-circuit's text in the instance's place.
void expand(Circuit& circuit, const Instance& instance, const Subcircuit& inside) {
  if (instance.pins.size() != inside.pins)
    throw std::invalid_argument("element " + instance.name +
                                ": its pins do not fit the sub-circuit");
  std::map<std::string, Node> nodes{{"0", 0}};
  const auto node = [&](const std::string& name) {
    const auto [at, is_new] = nodes.try_emplace(name, 0);
    if (is_new) at->second = add_node(circuit, name + '.' + instance.name);
    return at->second;
  };

  std::istringstream lines{std::string(inside.text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream text(line);
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty() || line[0] == '*') continue;
    const std::string name = words[0] + '.' + instance.name;
    if (words[0] == ".subckt")
      for (std::size_t pin = 0; pin < inside.pins; ++pin)
        nodes[words[2 + pin]] = instance.pins[pin];
    else if (line[0] == 'R')  // of the value {r}, as every resistor of the library's sub-circuits
      circuit.resistors.push_back({name, node(words[1]), node(words[2]), 1.0 / circuit.divider});
    else if (line[0] == 'X')
      circuit.instances.push_back(
          {name, {node(words[1]), node(words[2]), node(words[3])}, words[4]});
  }
}

}  // namespace

Node add_node(Circuit& circuit, std::string name) {
  circuit.nodes.push_back(std::move(name));
  return circuit.nodes.size() - 1;
}

std::vector<std::string> output_names(const Circuit& circuit) {
  std::vector<std::string> names;
  for (const Node node : circuit.outputs) names.push_back(circuit.nodes[node]);
  return names;
}

bool has_subcircuits(const Circuit& circuit) {
  return std::any_of(circuit.instances.begin(), circuit.instances.end(), [&](const Instance& x) {
    return amplifier(circuit, x.subcircuit) == nullptr;
  });
}

const AmplifierModel* amplifier(const Circuit& circuit, std::string_view name) {
  const auto found = std::find_if(circuit.amplifiers.begin(), circuit.amplifiers.end(),
                                  [&](const AmplifierModel& model) { return model.name == name; });
  return found == circuit.amplifiers.end() ? nullptr : &*found;
}

Circuit flattened(const Circuit& circuit) {
  Circuit flat = circuit;
  flat.instances.clear();
  for (const Instance& instance : circuit.instances) {
    const AmplifierModel* model = amplifier(circuit, instance.subcircuit);
    if (model == nullptr) {
      expand(flat, instance, subcircuit(instance.subcircuit));
      continue;
    }
    if (instance.pins.size() != (model->outputs == Outputs::single ? 3U : 4U))
      throw std::invalid_argument("element " + instance.name +
                                  ": its pins do not fit the amplifier");
    flat.instances.push_back(instance);
  }
  return flat;
}

std::vector<double> resistances(const Circuit& circuit) {
  std::vector<double> ohms;
  for (const Resistor& r : flattened(circuit).resistors) ohms.push_back(1.0 / r.siemens);
  return ohms;
}

ElementCounts count_elements(const Circuit& circuit) {
  const Circuit flat = flattened(circuit);
  const auto negative = [](const Resistor& resistor) { return resistor.siemens < 0.0; };
  return {.resistors = flat.resistors.size(),
          .negative_resistors = static_cast<std::size_t>(
              std::count_if(flat.resistors.begin(), flat.resistors.end(), negative)),
          .opamps = flat.instances.size(),
          .inductors = flat.inductors.size(),
          .capacitors = flat.capacitors.size(),
          .devices = flat.devices.size(),
          .sources = flat.sources.size()};
}

}  // namespace tactile_net

#include "tactile_net/network/flat_circuit.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "network/subcircuit_of.hpp"

namespace tactile_net {
namespace {

/// The elements of a sub-circuit's text. Its nodes are numbered: 0 ground, then the pins, then
/// those of its own.
struct Inside {
  struct Part {
    std::string name;
    std::vector<std::size_t> nodes;
    std::string model;  // of an amplifier
  };
  std::vector<std::string> own;  // names of its own nodes
  std::vector<Part> resistors;  // of the value {r}, as every resistor of the library's sub-circuits
  std::vector<Part> amplifiers;
};

Inside parse(const Subcircuit& subcircuit) {
  Inside inside;
  std::map<std::string, std::size_t> nodes{{"0", 0}};
  const auto node = [&](const std::string& name) {
    const auto [at, is_new] = nodes.try_emplace(name, 1 + subcircuit.pins + inside.own.size());
    if (is_new) inside.own.push_back(name);
    return at->second;
  };
  std::istringstream lines{std::string(subcircuit.text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream text(line);
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty() || line[0] == '*') continue;
    if (words[0] == ".subckt")
      for (std::size_t pin = 0; pin < subcircuit.pins; ++pin) nodes[words[2 + pin]] = 1 + pin;
    else if (line[0] == 'R')
      inside.resistors.push_back({words[0], {node(words[1]), node(words[2])}, {}});
    else if (line[0] == 'X')
      inside.amplifiers.push_back(
          {words[0], {node(words[1]), node(words[2]), node(words[3])}, words[4]});
  }
  return inside;
}

/// Puts the elements of a sub-circuit in the instance's place.
void expand(Circuit& circuit, const Instance& instance, const Inside& inside) {
  std::vector<Node> nodes{0};
  nodes.insert(nodes.end(), instance.pins.begin(), instance.pins.end());
  for (const std::string& name : inside.own)
    nodes.push_back(add_node(circuit, name + '.' + instance.name));
  for (const Inside::Part& r : inside.resistors)
    circuit.resistors.push_back({r.name + '.' + instance.name, nodes[r.nodes[0]], nodes[r.nodes[1]],
                                 1.0 / circuit.divider});
  for (const Inside::Part& x : inside.amplifiers)
    circuit.instances.push_back({x.name + '.' + instance.name,
                                 {nodes[x.nodes[0]], nodes[x.nodes[1]], nodes[x.nodes[2]]},
                                 x.model});
}

}  // namespace

FlatCircuit::FlatCircuit(const Circuit& circuit) : circuit_(circuit) {
  circuit_.instances.clear();
  std::map<const Subcircuit*, Inside> parsed;
  std::vector<bool> inside;
  for (const Instance& instance : circuit.instances) {
    const Subcircuit* const subcircuit = subcircuit_of(circuit, instance);
    if (subcircuit == nullptr) {
      circuit_.instances.push_back(instance);
      inside.push_back(false);
      continue;
    }
    had_subcircuits_ = true;
    auto at = parsed.find(subcircuit);
    if (at == parsed.end()) at = parsed.emplace(subcircuit, parse(*subcircuit)).first;
    expand(circuit_, instance, at->second);
    inside.resize(circuit_.instances.size(), true);
  }
  amplifiers_.reserve(circuit_.instances.size());
  for (const Instance& x : circuit_.instances) {
    const AmplifierModel* const model = amplifier(circuit_, x.subcircuit);
    if (model == nullptr)
      throw std::invalid_argument("element " + x.name + ": the circuit has no amplifier named '" +
                                  x.subcircuit + "'");
    amplifiers_.push_back({.plus = x.pins[0],
                           .minus = x.pins[1],
                           .out = x.pins[2],
                           .inverse = x.pins.size() > 3 ? x.pins[3] : 0,
                           .model = static_cast<std::size_t>(model - circuit_.amplifiers.data()),
                           .inside = inside[amplifiers_.size()]});
  }
}

std::vector<double> resistances(const FlatCircuit& circuit) {
  std::vector<double> ohms;
  for (const Resistor& r : circuit.circuit().resistors) ohms.push_back(1.0 / r.siemens);
  return ohms;
}

ElementCounts count_elements(const FlatCircuit& circuit) {
  const Circuit& flat = circuit.circuit();
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

#include "tactile_net/network/deck.hpp"

#include <charconv>
#include <cmath>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include "tactile_net/network/subcircuits.hpp"

namespace tactile_net {
namespace {

/// Shortest decimal text that reads back as the same number, in any locale. No SPICE suffix: `M`
/// is milli there, and `MEG` is mega.
void append(std::string& out, double number) {
  char buffer[32];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr);
}

void check_line(const std::string& text) {
  if (text.find_first_of("\r\n") != std::string::npos)
    throw std::invalid_argument("a deck's header line must not contain a line break");
}

/// Throws before anything is written.
void check(const Circuit& circuit, const DeckHeader& header) {
  check_line(header.title);
  for (const std::string& comment : header.comments) check_line(comment);
  if (!header.expected.empty() && header.expected.size() != circuit.outputs.size())
    throw std::invalid_argument("a deck needs one expected voltage per output");

  std::unordered_set<std::string_view> names;
  const auto check_element = [&](const std::string& name, bool valid, const char* rule) {
    if (!valid) throw std::invalid_argument("element " + name + ": " + rule);
    if (!names.insert(name).second)
      throw std::invalid_argument("element " + name + ": the name stands twice");
  };
  const std::size_t nodes = circuit.nodes.size();
  for (const Node node : circuit.outputs)
    if (node >= nodes) throw std::invalid_argument("an output is not a node of the circuit");
  names.reserve(circuit.resistors.size() + circuit.sources.size() + circuit.instances.size());
  for (const Resistor& r : circuit.resistors) {
    check_element(r.name, r.from < nodes && r.to < nodes, "a node does not exist");
    if (!std::isfinite(r.siemens) || r.siemens == 0.0 || !std::isfinite(1.0 / r.siemens))
      throw std::invalid_argument("element " + r.name +
                                  ": its conductance must be finite, not 0, and have a finite "
                                  "resistance; choose another scale");
  }
  for (const CurrentSource& i : circuit.sources)
    check_element(i.name, i.into < nodes && std::isfinite(i.ampere),
                  "its node must exist and its current be finite");
  for (const Instance& x : circuit.instances) {
    bool pins = x.pins.size() == subcircuit(x.subcircuit).pins;
    for (const Node node : x.pins) pins = pins && node < nodes;
    check_element(x.name, pins, "its pins do not fit the sub-circuit");
  }
}

void append_subcircuits(std::string& deck, const Circuit& circuit) {
  std::set<std::string_view> used;
  for (const Instance& instance : circuit.instances)
    for (std::string_view name = instance.subcircuit; !name.empty() && used.insert(name).second;)
      name = subcircuit(name).needs;
  for (const Subcircuit& one : subcircuits())
    if (used.contains(one.name)) deck += one.text;
}

void append_elements(std::string& deck, const Circuit& circuit) {
  const std::vector<std::string>& nodes = circuit.nodes;
  for (const Resistor& r : circuit.resistors) {
    deck += r.name + ' ' + nodes[r.from] + ' ' + nodes[r.to] + ' ';
    append(deck, 1.0 / r.siemens);
    deck += '\n';
  }
  for (const Instance& x : circuit.instances) {
    deck += x.name;
    for (const Node node : x.pins) deck += ' ' + nodes[node];
    deck += ' ' + x.subcircuit + '\n';
  }
  for (const CurrentSource& i : circuit.sources) {  // SPICE: from the first node to the second
    deck += i.name + " 0 " + nodes[i.into] + " DC ";
    append(deck, i.ampere);
    deck += '\n';
  }
}

}  // namespace

void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header,
                Answer answer) {
  check(circuit, header);
  std::string deck;
  deck.reserve(4096 + 48 * (circuit.resistors.size() + circuit.instances.size()));
  deck += "* " + header.title + '\n';  // line 1 is the title, whatever it holds
  for (const std::string& comment : header.comments) deck += "* " + comment + '\n';
  for (std::size_t i = 0; i < header.expected.size(); ++i) {
    deck += "* expect " + circuit.nodes[circuit.outputs[i]] + ' ';
    append(deck, header.expected[i]);
    deck += '\n';
  }
  append_subcircuits(deck, circuit);
  append_elements(deck, circuit);
  deck += ".op\n.end\n";
  if (answer == Answer::printed) {
    // `*#` lines are commands to ngspice and comments to every other simulator. Without `quit 0`
    // it would exit with 1 for want of a .print card. With numdgt=16
    // negative numbers get one digit too few to read back as the same double.
    deck += "*# set numdgt=17\n*# op\n";
    for (const Node node : circuit.outputs) deck += "*# print v(" + circuit.nodes[node] + ")\n";
    deck += "*# quit 0\n";
  }
  out << deck;
}

}  // namespace tactile_net

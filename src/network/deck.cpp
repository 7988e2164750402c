#include "tactile_net/network/deck.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include "network/subcircuit_of.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

void check_line(const std::string& text) {
  if (text.find_first_of("\r\n") != std::string::npos)
    throw std::invalid_argument("a deck's header line must not contain a line break");
}

/// Throws before anything is written.
class Check {
 public:
  explicit Check(const Circuit& circuit) : circuit_(circuit) {
    for (const Node node : circuit.outputs)
      if (!exists(node)) throw std::invalid_argument("an output is not a node of the circuit");
    for (const Resistor& r : circuit.resistors) {
      two_terminals(r);
      element(r.name,
              std::isfinite(r.siemens) && r.siemens != 0.0 && std::isfinite(1.0 / r.siemens),
              "its conductance must be finite, not 0, and have a finite resistance; choose "
              "another scale");
    }
    for (const Capacitor& c : circuit.capacitors) {
      two_terminals(c);
      element(c.name, c.farad > 0.0 && std::isfinite(c.farad), "it must be > 0 and finite");
    }
    for (const Inductor& l : circuit.inductors) {
      two_terminals(l);
      element(l.name, l.henry > 0.0 && std::isfinite(l.henry), "it must be > 0 and finite");
    }
    for (const NShapedDevice& b : circuit.devices) {
      two_terminals(b);
      element(
          b.name,
          b.siemens > 0.0 && std::isfinite(b.siemens) && b.volts > 0.0 && std::isfinite(b.volts),
          "its slope and its voltage must be > 0 and finite");
    }
    for (const CurrentSource& i : circuit.sources) {
      unique(i.name);
      element(i.name, exists(i.into) && std::isfinite(i.ampere),
              "its node must exist and its current be finite");
    }
    for (const Instance& x : circuit.instances) {
      unique(x.name);
      (void)subcircuit_of(circuit, x);
      element(x.name,
              std::all_of(x.pins.begin(), x.pins.end(), [&](Node node) { return exists(node); }),
              "a node does not exist");
    }
    if (!(circuit.divider > 0.0) || !std::isfinite(circuit.divider))
      throw std::invalid_argument("a sub-circuit's resistors must be > 0 and finite");
  }

 private:
  [[nodiscard]] bool exists(Node node) const { return node < circuit_.nodes.size(); }
  static void element(const std::string& name, bool valid, const char* rule) {
    if (!valid) throw std::invalid_argument("element " + name + ": " + rule);
  }
  void unique(const std::string& name) {
    element(name, names_.insert(name).second, "the name stands twice");
  }
  void two_terminals(const auto& part) {
    unique(part.name);
    element(part.name, exists(part.from) && exists(part.to), "a node does not exist");
  }

  const Circuit& circuit_;
  std::unordered_set<std::string_view> names_;
};

void check(const Analysis& analysis) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (const auto* ac = std::get_if<SingleFrequency>(&analysis); ac && !positive(ac->hertz))
    throw std::invalid_argument("a frequency must be > 0 and finite");
  if (const auto* tran = std::get_if<StepResponse>(&analysis);
      tran && !(positive(tran->step) && positive(tran->stop) && tran->step < tran->stop))
    throw std::invalid_argument("a transient needs 0 < step < stop");
}

void check(const Circuit& circuit, const DeckHeader& header, const Analysis& analysis) {
  check_line(header.title);
  for (const std::string& comment : header.comments) check_line(comment);
  if (!header.expected.empty() && header.expected.size() != circuit.outputs.size())
    throw std::invalid_argument("a deck needs one expected voltage per output");
  (void)Check(circuit);
  check(analysis);
}

/// The sub-circuits that are used, the amplifiers in them included, each once.
void append_subcircuits(std::string& deck, const Circuit& circuit) {
  std::set<std::string_view> used;
  for (const Instance& instance : circuit.instances) used.insert(instance.subcircuit);
  std::string library;
  for (const Subcircuit& one : subcircuits())
    if (used.contains(one.name)) {
      library += one.text;
      used.insert("opamp");
    }
  for (const AmplifierModel& model : circuit.amplifiers)
    if (used.contains(model.name)) deck += subcircuit_text(model);
  deck += library;
}

/// Without `^`: a power to ngspice, an exclusive or to LTspice.
std::string current_of(const NShapedDevice& b, const std::vector<std::string>& nodes) {
  const std::string u = "V(" + nodes[b.from] + "," + nodes[b.to] + ")/" + shortest(b.volts);
  if (b.curve == Curve::cubic)
    return shortest(-b.siemens * b.volts) + "*(" + u + ")*(1-(" + u + ")*(" + u + "))";
  return shortest(b.siemens * b.volts) + "*((2+" + u + ")*exp(-" + u + ")-2)";
}

/// The step of source number `place`; its edge takes a millionth of the time.
std::string step_of(double ampere, const StepResponse& response, std::size_t place) {
  const double edge = response.stop / 1e6;
  double first = ampere;
  double until = 0.0;
  if (response.overdrive_until > 0.0) {
    first = response.overdrive * ampere;
    until = response.overdrive_until;
  } else if (response.kick > 0.0) {
    first = ampere * (1.0 + response.kick * std::cos(1.0 + 2.4 * static_cast<double>(place)));
    until = response.stop / 1e3;
  }
  const std::string end = shortest(ampere);
  std::string text = "PWL(0 0 " + shortest(edge) + ' ' + shortest(first);
  if (until > 0.0)
    text +=
        ' ' + shortest(until) + ' ' + shortest(first) + ' ' + shortest(until + edge) + ' ' + end;
  return text + ')';
}

void append_elements(std::string& deck, const Circuit& circuit, const Analysis& analysis) {
  const std::vector<std::string>& nodes = circuit.nodes;
  const auto card = [&](const auto& part, const std::string& value) {
    deck += part.name + ' ' + nodes[part.from] + ' ' + nodes[part.to] + ' ' + value + '\n';
  };
  for (const Resistor& r : circuit.resistors) card(r, shortest(1.0 / r.siemens));
  for (const Capacitor& c : circuit.capacitors) card(c, shortest(c.farad));
  for (const Inductor& l : circuit.inductors) card(l, shortest(l.henry));
  for (const NShapedDevice& b : circuit.devices) card(b, "I=" + current_of(b, nodes));
  for (const Instance& x : circuit.instances) {
    deck += x.name;
    for (const Node node : x.pins) deck += ' ' + nodes[node];
    deck += ' ' + x.subcircuit;
    if (circuit.divider != Circuit{}.divider && amplifier(circuit, x.subcircuit) == nullptr)
      deck += " r=" + shortest(circuit.divider);
    deck += '\n';
  }
  for (const CurrentSource& i : circuit.sources) {  // SPICE: from the first node to the second
    deck += i.name + " 0 " + nodes[i.into];
    if (std::holds_alternative<DirectCurrent>(analysis))
      deck += " DC " + shortest(i.ampere);
    else if (std::holds_alternative<SingleFrequency>(analysis))
      deck += " AC " + shortest(i.ampere) + " 90";
    else
      deck += ' ' + step_of(i.ampere, std::get<StepResponse>(analysis),
                            static_cast<std::size_t>(&i - circuit.sources.data()));
    deck += '\n';
  }
}

/// Keeps the outputs alone: every node at every step would take hundreds of megabytes.
std::string saved(const Circuit& circuit) {
  std::string text;
  for (const Node node : circuit.outputs) text += ".save v(" + circuit.nodes[node] + ")\n";
  return text;
}

/// The card of an analysis, with the options it needs.
std::string card_of(const Circuit& circuit, const Analysis& analysis) {
  if (const auto* ac = std::get_if<SingleFrequency>(&analysis)) {
    const std::string hertz = shortest(ac->hertz);
    // Capacitors alone and loops of inductors have no operating point.
    return ".options noopac\n.ac lin 1 " + hertz + ' ' + hertz + '\n';
  }
  if (const auto* tran = std::get_if<StepResponse>(&analysis)) {
    const std::string step = shortest(tran->step);
    return ".options method=trap reltol=1e-5 chgtol=1e-18 abstol=1e-15 vntol=1e-9\n.tran " + step +
           ' ' + shortest(tran->stop) + " 0 " + step + '\n' + saved(circuit);
  }
  return ".op\n";
}

/// `*#` lines are commands to ngspice and comments to every other simulator. Without `quit 0` it
/// would exit with 1 for want of a .print card. With numdgt=16 negative numbers get one digit too
/// few to read back as the same double.
std::string commands_for(const Circuit& circuit, const Analysis& analysis) {
  std::string text = "*# set numdgt=17\n*# run\n";
  const bool ac = std::holds_alternative<SingleFrequency>(analysis);
  for (const Node node : circuit.outputs)
    text += (ac ? "*# print real(v(" : "*# print v(") + circuit.nodes[node] + (ac ? "))\n" : ")\n");
  return text + "*# quit 0\n";
}

}  // namespace

void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header, Answer answer,
                const Analysis& analysis) {
  check(circuit, header, analysis);
  std::string deck;
  deck.reserve(4096 + 48 * (circuit.resistors.size() + circuit.instances.size()));
  deck += "* " + header.title + '\n';  // line 1 is the title, whatever it holds
  for (const std::string& comment : header.comments) deck += "* " + comment + '\n';
  for (std::size_t i = 0; i < header.expected.size(); ++i)
    deck +=
        "* expect " + circuit.nodes[circuit.outputs[i]] + ' ' + shortest(header.expected[i]) + '\n';
  if (header.within) deck += "* within " + shortest(*header.within) + '\n';
  append_subcircuits(deck, circuit);
  append_elements(deck, circuit, analysis);
  deck += card_of(circuit, analysis) + ".end\n";
  if (answer == Answer::printed) deck += commands_for(circuit, analysis);
  out << deck;
}

}  // namespace tactile_net

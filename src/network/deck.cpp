#include "tactile_net/network/deck.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include "network/node_names.hpp"
#include "network/subcircuit_of.hpp"
#include "tactile_net/network/dialect_deck.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

void check_line(const std::string& text) {
  if (text.find_first_of("\r\n") != std::string::npos)
    throw std::invalid_argument("a deck's header line must not contain a line break");
}

/// Of a sub-circuit of its own.
void check_name(const std::string& name, const Circuit& circuit) {
  const auto in_name = [](char one) {
    return std::isalnum(static_cast<unsigned char>(one)) != 0 || one == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), in_name))
    throw std::invalid_argument("a sub-circuit's name is of letters, digits and _");
  for (const AmplifierModel& inside : circuit.amplifiers)
    if (in_lower_case(name) == in_lower_case(inside.name))
      throw std::invalid_argument("a sub-circuit's name must not be '" + inside.name +
                                  "', which one inside it has: it would hold itself");
}

/// Throws before anything is written.
class Check {
 public:
  explicit Check(const Circuit& circuit) : circuit_(circuit) {
    check_node_names(circuit);
    for (const Node node : circuit.outputs)
      if (!exists(node)) throw std::invalid_argument("an output is not a node of the circuit");
    for (const AmplifierModel& model : circuit.amplifiers) sub_circuit(model.name);
    for (const Resistor& r : circuit.resistors) {
      two_terminals(r, 'R');
      element(r.name,
              std::isfinite(r.siemens) && r.siemens != 0.0 && std::isfinite(1.0 / r.siemens),
              "its conductance must be finite, not 0, and have a finite resistance; choose "
              "another scale");
    }
    for (const Capacitor& c : circuit.capacitors) {
      two_terminals(c, 'C');
      element(c.name, c.farad > 0.0 && std::isfinite(c.farad), "it must be > 0 and finite");
    }
    for (const Inductor& l : circuit.inductors) {
      two_terminals(l, 'L');
      element(l.name, l.henry > 0.0 && std::isfinite(l.henry), "it must be > 0 and finite");
    }
    for (const NShapedDevice& b : circuit.devices) {
      two_terminals(b, 'B');
      element(
          b.name,
          b.siemens > 0.0 && std::isfinite(b.siemens) && b.volts > 0.0 && std::isfinite(b.volts),
          "its slope and its voltage must be > 0 and finite");
    }
    for (const CurrentSource& i : circuit.sources) {
      unique(i.name, i.volts ? 'V' : 'I');
      element(i.name, exists(i.into) && std::isfinite(i.volts.value_or(i.ampere)),
              "its node must exist and its current or voltage be finite");
    }
    for (const Instance& x : circuit.instances) {
      unique(x.name, 'X');
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
  /// @param letter  by which simulators know what the element is
  void unique(const std::string& name, char letter) {
    if (!is_word(name))
      throw std::invalid_argument(
          "element " + quoted_name(name) +
          ": an element's name must be one word of ASCII letters, digits, _ and .");
    if (std::toupper(static_cast<unsigned char>(name.front())) != letter)
      throw std::invalid_argument("element " + name + ": its name must begin with " + letter +
                                  ", by which simulators know what it is; rename it");
    element(name, names_.insert(in_lower_case(name)).second, "the name stands twice");
  }
  /// Of an amplifier's model; simulators take one of two that have the same name for both.
  void sub_circuit(const std::string& name) {
    if (!is_word(name))
      throw std::invalid_argument(
          "amplifier model " + quoted_name(name) +
          ": a model's name must be one word of ASCII letters, digits, _ and .");
    const auto is_it = [&](const Subcircuit& one) { return one.name == in_lower_case(name); };
    const auto library = subcircuits();
    if (!sub_circuits_.insert(in_lower_case(name)).second ||
        std::any_of(library.begin(), library.end(), is_it))
      throw std::invalid_argument("amplifier model " + name +
                                  ": another sub-circuit has that name, whatever its case; give "
                                  "each model a name of its own");
  }
  void two_terminals(const auto& part, char letter) {
    unique(part.name, letter);
    element(part.name, exists(part.from) && exists(part.to), "a node does not exist");
  }

  const Circuit& circuit_;
  std::unordered_set<std::string> names_;
  std::unordered_set<std::string> sub_circuits_;
};

void check(const Analysis& analysis) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (const auto* ac = std::get_if<SingleFrequency>(&analysis);
      ac != nullptr && !positive(ac->hertz))
    throw std::invalid_argument("a frequency must be > 0 and finite");
  if (const auto* tran = std::get_if<StepResponse>(&analysis);
      tran != nullptr && !(positive(tran->step) && positive(tran->stop) && tran->step < tran->stop))
    throw std::invalid_argument("a transient needs 0 < step < stop");
}

void check(const Circuit& circuit, const DeckHeader& header, const Analysis& analysis,
           const DeckForm& form) {
  if (!form.parts.empty() && form.parts.size() != circuit.resistors.size())
    throw std::invalid_argument("a deck's parts need a value for every resistor");
  check_line(header.title);
  for (const std::string& comment : header.comments) check_line(comment);
  if (!header.expected.empty() && header.expected.size() != circuit.outputs.size())
    throw std::invalid_argument("a deck needs one expected voltage per output");
  (void)Check(circuit);
  check(analysis);
}

/// A sub-circuit as a dialect writes its parameters, and the currents of its B cards.
std::string in_dialect(std::string text, Dialect dialect) {
  if (dialect != Dialect::xyce) return text;
  for (std::size_t at = text.find("\nB"); at != std::string::npos; at = text.find("\nB", at)) {
    text.insert(at = text.find("I=", at) + 2, 1, '{');
    text.insert(at = text.find('\n', at), 1, '}');
  }
  const std::size_t card = text.find("\n.subckt ") + 1;
  const std::size_t sign = text.find('=', card);
  if (sign < text.find('\n', card)) text.insert(text.rfind(' ', sign) + 1, "PARAMS: ");
  return text;
}

/// The sub-circuits that are used, the amplifiers in them included, each once.
void append_subcircuits(std::string& deck, const Circuit& circuit, Dialect dialect) {
  std::set<std::string_view> used;
  for (const Instance& instance : circuit.instances) used.insert(instance.subcircuit);
  std::string library;
  for (const Subcircuit& one : subcircuits())
    if (used.contains(one.name)) {
      library += in_dialect(std::string(one.text), dialect);
      used.insert("opamp");
    }
  for (const AmplifierModel& model : circuit.amplifiers)
    if (used.contains(model.name)) deck += in_dialect(subcircuit_text(model), dialect);
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

/// Everything but the sources.
void append_parts(std::string& deck, const Circuit& circuit, const DeckForm& form) {
  const auto& [dialect, parts] = form;
  const std::vector<std::string>& nodes = circuit.nodes;
  const auto card = [&](const auto& part, const std::string& value) {
    deck += part.name + ' ' + nodes[part.from] + ' ' + nodes[part.to] + ' ' + value + '\n';
  };
  for (std::size_t r = 0; r < circuit.resistors.size(); ++r) {
    if (parts.empty())
      card(circuit.resistors[r], shortest(1.0 / circuit.resistors[r].siemens));
    else
      card(circuit.resistors[r], shortest(parts[r].ohm) + " ; " + percent(parts[r].tolerance));
  }
  for (const Capacitor& c : circuit.capacitors) card(c, shortest(c.farad));
  for (const Inductor& l : circuit.inductors) card(l, shortest(l.henry));
  for (const NShapedDevice& b : circuit.devices) {
    const std::string current = current_of(b, nodes);
    card(b, "I=" + (dialect == Dialect::xyce ? '{' + current + '}' : current));
  }
  for (const Instance& x : circuit.instances) {
    deck += x.name;
    for (const Node node : x.pins) deck += ' ' + nodes[node];
    deck += ' ' + x.subcircuit;
    if (circuit.divider != Circuit{}.divider && amplifier(circuit, x.subcircuit) == nullptr)
      deck += (dialect == Dialect::xyce ? " PARAMS: r=" : " r=") + shortest(circuit.divider);
    deck += '\n';
  }
}

void append_sources(std::string& deck, const Circuit& circuit, const Analysis& analysis) {
  const std::vector<std::string>& nodes = circuit.nodes;
  for (const CurrentSource& i : circuit.sources) {
    // SPICE: a current from the first node to the second, a voltage of the first over the second.
    deck += i.name + (i.volts ? ' ' + nodes[i.into] + " 0" : " 0 " + nodes[i.into]);
    const double value = i.volts.value_or(i.ampere);
    if (std::holds_alternative<DirectCurrent>(analysis))
      deck += " DC " + shortest(value);
    else if (std::holds_alternative<SingleFrequency>(analysis))
      deck += " AC " + shortest(value) + " 90";
    else
      deck += ' ' + step_of(value, std::get<StepResponse>(analysis),
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

/// What Xyce prints.
std::string printed_by_xyce(const Circuit& circuit, const char* analysis, const char* value) {
  std::string text = ".print ";
  text += analysis;
  for (const Node node : circuit.outputs) {
    text += ' ';
    text += value;
    text += '(' + circuit.nodes[node] + ')';
  }
  return text + '\n';
}

/// The card of an analysis, with the options it needs.
std::string card_of(const Circuit& circuit, const Analysis& analysis, Dialect dialect) {
  const bool xyce = dialect == Dialect::xyce;
  if (const auto* ac = std::get_if<SingleFrequency>(&analysis)) {
    const std::string hertz = shortest(ac->hertz);
    // Capacitors alone and loops of inductors have no operating point.
    return (dialect == Dialect::ngspice ? ".options noopac\n" : "") + (".ac lin 1 " + hertz) + ' ' +
           hertz + '\n' + (xyce ? printed_by_xyce(circuit, "ac", "vr") : "");
  }
  if (const auto* tran = std::get_if<StepResponse>(&analysis)) {
    const std::string step = shortest(tran->step);
    return (xyce
                ? ".options timeint method=trap reltol=1e-5 abstol=1e-9\n.tran "
                : ".options method=trap reltol=1e-5 chgtol=1e-18 abstol=1e-15 vntol=1e-9\n.tran ") +
           step + ' ' + shortest(tran->stop) + " 0 " + step + '\n' +
           (xyce ? printed_by_xyce(circuit, "tran", "v") : saved(circuit));
  }
  if (!xyce || circuit.sources.empty()) return ".op\n";
  // Xyce prints no operating point; a sweep of one point is one.
  const CurrentSource& first = circuit.sources.front();
  const std::string value = shortest(first.volts.value_or(first.ampere));
  return ".dc " + first.name + ' ' + value + ' ' + value + " 1\n" +
         printed_by_xyce(circuit, "dc", "v");
}

/// Behind `.end`, where every other simulator has ceased to read. Not as `*#` lines: ngspice takes
/// them for comments where PSpice's rules are set (`set ngbehavior=psa`). Without `quit 0` it would
/// exit with 1 for want of a .print card. With numdgt=16 negative numbers get one digit too few to
/// read back as the same double.
std::string commands_for(const Circuit& circuit, const Analysis& analysis) {
  constexpr std::size_t most_in_a_line = 100;  // ngspice takes a thousand words
  std::string text = ".control\nset numdgt=17\nrun";
  const bool ac = std::holds_alternative<SingleFrequency>(analysis);
  for (std::size_t i = 0; i < circuit.outputs.size(); ++i) {
    if (i % most_in_a_line == 0) text += "\nprint";
    text += (ac ? " real(v(" : " v(") + circuit.nodes[circuit.outputs[i]] + (ac ? "))" : ")");
  }
  return text + "\nquit 0\n.endc\n";
}

constexpr double inductors_ohm = 1e-3;
constexpr double outputs_ohm = 1e12;

/// The same circuit with an operating point.
Circuit with_operating_point(Circuit circuit) {
  for (Inductor& one : circuit.inductors) {
    const Node between = add_node(circuit, 'm' + one.name);
    circuit.resistors.push_back({"R" + one.name, between, one.to, 1.0 / inductors_ohm});
    one.to = between;
  }
  for (const Node node : circuit.outputs)
    circuit.resistors.push_back({"Ro" + circuit.nodes[node], node, 0, 1.0 / outputs_ohm});
  return circuit;
}

std::string comments_of(const Circuit& circuit, const DeckHeader& header, Dialect dialect) {
  std::string text;
  for (const std::string& comment : header.comments) text += "* " + comment + '\n';
  const bool negative = std::any_of(circuit.resistors.begin(), circuit.resistors.end(),
                                    [](const Resistor& r) { return r.siemens < 0.0; });
  if (negative && dialect != Dialect::ngspice)
    text += "* " + std::string(negative_resistors_untested) + '\n';
  return text;
}

std::string deck_of(const Circuit& circuit, const DeckHeader& header, Answer answer,
                    const Analysis& analysis, const DeckForm& form) {
  const Dialect dialect = form.dialect;
  std::string deck;
  deck.reserve(4096 + 48 * (circuit.resistors.size() + circuit.instances.size()));
  deck += "* " + header.title + '\n';  // line 1 is the title, whatever it holds
  deck += comments_of(circuit, header, dialect);
  for (std::size_t i = 0; i < header.expected.size(); ++i)
    deck +=
        "* expect " + circuit.nodes[circuit.outputs[i]] + ' ' + shortest(header.expected[i]) + '\n';
  if (header.within) deck += "* within " + shortest(*header.within) + '\n';
  append_subcircuits(deck, circuit, dialect);
  append_parts(deck, circuit, form);
  append_sources(deck, circuit, analysis);
  deck += card_of(circuit, analysis, dialect) + ".end\n";
  if (answer == Answer::printed && dialect == Dialect::ngspice)
    deck += commands_for(circuit, analysis);
  return deck;
}

}  // namespace

void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header, Answer answer,
                const Analysis& analysis, const DeckForm& form) {
  check(circuit, header, analysis, form);
  const bool floats =
      form.dialect != Dialect::ngspice && std::holds_alternative<SingleFrequency>(analysis);
  const Circuit written = floats ? with_operating_point(circuit) : circuit;
  if (floats) check(written, header, analysis, form);  // what was added has names, too
  const std::string deck = deck_of(written, header, answer, analysis, form);
  check_dialect(deck, form.dialect);
  out << deck;
}

void write_deck(std::ostream& out, const Circuit& circuit, const DeckHeader& header, Answer answer,
                const Analysis& analysis) {
  write_deck(out, circuit, header, answer, analysis, DeckForm{});
}

std::vector<Node> ports(const Circuit& circuit) {
  std::vector<Node> nodes;
  const auto add = [&](Node node) {
    if (node != 0 && std::find(nodes.begin(), nodes.end(), node) == nodes.end())
      nodes.push_back(node);
  };
  for (const CurrentSource& one : circuit.sources) add(one.into);
  for (const Node node : circuit.outputs) add(node);
  return nodes;
}

void write_subcircuit(std::ostream& out, const Circuit& circuit, const DeckHeader& header,
                      const std::string& name, const DeckForm& form) {
  check(circuit, header, DirectCurrent{}, form);
  check_name(name, circuit);
  std::string text = "* " + header.title + '\n' + comments_of(circuit, header, form.dialect);
  text +=
      "* Pins: the nodes of the readings' currents or voltages, then the outputs.\n.subckt " + name;
  for (const Node node : ports(circuit)) text += ' ' + circuit.nodes[node];
  text += '\n';
  // ngspice knows sub-circuits with parameters inside others "only marginally": converters opened.
  const Circuit flat = FlatCircuit(circuit).circuit();
  check(flat, header, DirectCurrent{}, form);
  append_subcircuits(text, flat, form.dialect);
  append_parts(text, flat, form);
  text += ".ends " + name + '\n';
  check_dialect(text, form.dialect);
  out << text;
}

void write_symbol(std::ostream& out, const Circuit& circuit, const std::string& name,
                  const std::string& file) {
  check_node_names(circuit);
  check_name(name, circuit);
  check_line(file);
  const std::vector<Node> pins = ports(circuit);
  const auto is_output = [&](Node node) {
    return std::find(circuit.outputs.begin(), circuit.outputs.end(), node) != circuit.outputs.end();
  };
  constexpr int pitch = 16;
  int left = 0;
  int right = 0;
  std::string text;
  for (std::size_t k = 0; k < pins.size(); ++k) {
    const bool output = is_output(pins[k]);
    int& count = output ? right : left;
    text += "PIN " + std::to_string(output ? 96 : -96) + ' ' + std::to_string(pitch * ++count) +
            (output ? " RIGHT 8\n" : " LEFT 8\n");
    text += "PINATTR PinName " + circuit.nodes[pins[k]] + "\nPINATTR SpiceOrder " +
            std::to_string(k + 1) + '\n';
  }
  const int height = pitch * (std::max(left, right) + 1);
  out << "Version 4\nSymbolType BLOCK\nRECTANGLE Normal -96 0 96 " << height
      << "\nWINDOW 0 0 -8 Bottom 2\nWINDOW 3 0 " << height + 8
      << " Top 2\nSYMATTR Prefix X\nSYMATTR Value " << name << "\nSYMATTR ModelFile " << file
      << '\n'
      << text;
}

}  // namespace tactile_net

#include "tactile_net/decks/macromodel.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <stdexcept>

#include "decks/deck_cards.hpp"
#include "decks/deck_rules.hpp"
#include "decks/deck_size.hpp"
#include "numeric/lower_case.hpp"
#include "numeric/named.hpp"
#include "tactile_net/network/subcircuits.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::decks {
namespace {

using Pin = MacromodelPin;

constexpr std::uintmax_t largest_macromodel = std::uintmax_t{4} << 20;
constexpr std::size_t most_cards = 20'000;
constexpr double most_elements_in_all = 1e6;

[[noreturn]] void refuse_model(const std::string& file, std::size_t line,
                               const std::string& message, const std::string& hint) {
  throw InputError({Diagnostic{file, line, line == 0 ? 0U : 1U, message, hint, {}, 0}});
}

std::string_view pin_name(Pin pin) { return name_in<Enumerators<Pin>::all>(pin); }

std::string listed(const std::vector<Pin>& pins) {
  std::string text;
  for (const Pin pin : pins) {
    if (!text.empty()) text += ' ';
    text += pin_name(pin);
  }
  return text;
}

/// What is usual: of an op-amp of one output, and of two with a pin for their mean; a last one may
/// be for power-down.
std::vector<Pin> usual_pins(Outputs outputs, std::size_t count) {
  std::vector<Pin> pins = {Pin::in_plus, Pin::in_minus, Pin::supply_plus, Pin::supply_minus};
  if (outputs == Outputs::single)
    pins.push_back(Pin::out);
  else
    pins.insert(pins.end(), {Pin::out_plus, Pin::out_minus, Pin::common_mode});
  if (count == pins.size() + 1) pins.push_back(Pin::power_down);
  return pins;
}

std::vector<Pin> needed_pins(Outputs outputs) {
  if (outputs == Outputs::single) return {Pin::in_plus, Pin::in_minus, Pin::out};
  return {Pin::in_plus, Pin::in_minus, Pin::out_plus, Pin::out_minus};
}

struct Definition {
  std::string name{};
  std::size_t pins = 0;
  std::size_t line = 0;
};

/// `.subckt name a b c PARAMS: x=1`: of the name and the pins alone.
Definition definition_of(const DeckCard& card) {
  std::istringstream words(card.text);
  Definition found{.line = card.line};
  std::string word;
  words >> word >> found.name;
  while (words >> word && word != "params:" && word != "optional:" &&
         word.find('=') == std::string::npos)
    ++found.pins;
  // "gain = 3": what stands before the sign is no pin.
  if (word == "=" && found.pins > 0) found.pins -= 1;
  return found;
}

std::vector<Definition> definitions_in(const DeckText& deck) {
  std::vector<Definition> found;
  int depth = 0;
  for (const DeckCard& card : deck.cards) {
    if (card.text.starts_with(".subckt") && depth++ == 0) found.push_back(definition_of(card));
    if (card.text.starts_with(".ends")) depth -= 1;
  }
  return found;
}

/// The sub-circuit that stands for the op-amp.
const Definition& chosen(const std::vector<Definition>& all, const DeckText& deck,
                         const MacromodelOptions& options, std::string_view part,
                         const std::string& file) {
  if (all.empty())
    refuse_model(file, 0, "has no .subckt: it holds no macromodel",
                 "a vendor's PSpice model, whose first card is such as .subckt THS4551 1 2 3 4 5");
  std::vector<const Definition*> fitting;
  std::string names;
  for (const Definition& one : all) {
    names += (names.empty() ? "" : ", ") + one.name;
    if (!options.name.empty() && one.name == lower_case(options.name)) return one;
    if (!part.empty() && one.name.starts_with(lower_case(part))) fitting.push_back(&one);
  }
  const std::string how = "in the scene, under [network], model = { name = \"" + all.front().name +
                          "\" }; the file has " + names;
  if (!options.name.empty())
    refuse_model(file, 0, "has no sub-circuit '" + options.name + "'", how);
  if (fitting.empty())
    for (const Definition& one : all) {  // those that no other calls
      const bool called = std::any_of(deck.cards.begin(), deck.cards.end(), [&](const auto& card) {
        return card.text.front() == 'x' &&
               (" " + card.text + " ").find(" " + one.name + " ") != std::string::npos;
      });
      if (!called) fitting.push_back(&one);
    }
  if (fitting.empty())
    refuse_model(file, 0, "has no sub-circuit that no other calls: they call one another", how);
  if (fitting.size() != 1)
    refuse_model(file, 0, "has several sub-circuits, and which one is the op-amp is not said", how);
  return *fitting.front();
}

std::string how_to_map(const std::vector<Pin>& pins) {
  std::string text = "in the scene, under [network], model = { pins = [";
  for (std::size_t i = 0; i < pins.size(); ++i) {
    if (i > 0) text += ", ";
    text += '"' + std::string(pin_name(pins[i])) + '"';
  }
  return text + "] }, in the order of its .subckt line; \"ground\" and \"open\" too";
}

std::vector<Pin> pins_of(const Definition& definition, const MacromodelOptions& options,
                         Outputs outputs, const std::string& file) {
  const std::vector<Pin> usual = usual_pins(outputs, definition.pins);
  const std::vector<Pin>& pins = options.pins.empty() ? usual : options.pins;
  if (pins.size() != definition.pins)
    refuse_model(file, definition.line,
                 "sub-circuit '" + definition.name + "' has " + std::to_string(definition.pins) +
                     " pins, and " + std::to_string(pins.size()) +
                     (options.pins.empty() ? " are expected" : " are mapped") + ": " + listed(pins),
                 how_to_map(usual));
  for (const Pin needed : needed_pins(outputs))
    if (std::count(pins.begin(), pins.end(), needed) != 1)
      refuse_model(file, definition.line,
                   "the pins that are mapped have not one " + std::string(pin_name(needed)) + ": " +
                       listed(pins),
                   how_to_map(usual));
  return pins;
}

/// The sub-circuit of ours that the circuit calls, made of the macromodel.
std::string wrapper(const AmplifierModel& amplifier, const Macromodel& model) {
  const bool both = amplifier.outputs == Outputs::complementary;
  const std::string half = shortest(0.5 * model.supply);
  std::string text = ".subckt " + amplifier.name + " p n out" + (both ? " inv" : "") +
                     "\nVhigh high 0 " + half + "\nVlow low 0 -" + half + '\n';
  std::string call = "Xmodel";
  int open = 0;
  for (const Pin pin : model.pins) {
    switch (pin) {
      case Pin::in_plus:
        call += " p";
        break;
      case Pin::in_minus:
        call += " n";
        break;
      case Pin::out:
      case Pin::out_plus:
        call += " out";
        break;
      case Pin::out_minus:
        call += " inv";
        break;
      case Pin::supply_plus:
      case Pin::power_down:
        call += " high";
        break;
      case Pin::supply_minus:
        call += " low";
        break;
      case Pin::common_mode:
      case Pin::ground:
        call += " 0";
        break;
      case Pin::open: {
        const std::string node = "open" + std::to_string(open++);
        text.append("R").append(node).append(" ").append(node).append(" 0 1e12\n");
        call += ' ' + node;
        break;
      }
    }
  }
  const auto load = [&](const char* name, const char* node, double farad) {
    if (farad > 0.0) text += std::string("C") + name + ' ' + node + " 0 " + shortest(farad) + '\n';
  };
  load("n", "n", model.board_input);
  load("out", "out", model.board_output);
  if (both) load("p", "p", model.board_input);
  if (both) load("inv", "inv", model.board_output);
  return text + call + ' ' + model.name + "\n.ends " + amplifier.name + '\n';
}

}  // namespace

Macromodel read_macromodel(const std::string& path, const MacromodelOptions& options,
                           std::string_view part, Outputs outputs, double supply) {
  const std::string text =
      bounded_text(path, largest_macromodel, "a macromodel of an op-amp has some kilobytes");
  const std::string lower = lower_case(text);
  for (const char* word : {"$cdnencstart", "$encrypted_lib"})
    if (lower.find(word) != std::string::npos)
      refuse_model(path, 0, "is encrypted, for one simulator alone",
                   "ask the vendor for a macromodel that is not");
  const DeckText deck = deck_cards(text, path, FirstLine::card);
  if (deck.cards.size() > most_cards)
    refuse_model(path, deck.cards[most_cards].line,
                 "has more than " + std::to_string(most_cards) + " cards",
                 "a macromodel of an op-amp has some hundred");
  check_cards(deck, path, DeckKind::macromodel);
  const std::vector<Definition> definitions = definitions_in(deck);
  const Definition& definition = chosen(definitions, deck, options, part, path);

  Macromodel model{.file = path,
                   .name = definition.name,
                   .supply = options.supply.value_or(supply),
                   .board_input = options.board_input,
                   .board_output = options.board_output};
  model.pins = pins_of(definition, options, outputs, path);
  DeckText one = deck;
  std::string call = "x1";
  for (std::size_t i = 0; i < definition.pins; ++i) call += " n" + std::to_string(i);
  one.cards.push_back({.line = definition.line, .text = call + ' ' + definition.name});
  model.elements = check_size(one, path);
  if (model.elements > most_elements_in_all)
    refuse_model(path, definition.line,
                 "sub-circuit '" + model.name + "' has more than a million elements",
                 "a macromodel of an op-amp has some hundred");
  for (const DeckCard& card : deck.cards) model.text += card.text + '\n';
  return model;
}

MacromodelSimulator::MacromodelSimulator(Simulator& simulator, const Macromodel& model,
                                         const Circuit& circuit)
    : simulator_(&simulator), library_(model.text) {
  if (model.elements * static_cast<double>(circuit.instances.size()) > most_elements_in_all)
    refuse_model(model.file, 0,
                 "has " + brief(model.elements) + " elements, and the circuit " +
                     std::to_string(circuit.instances.size()) +
                     " op-amps: more than a million in all",
                 "take a smaller circuit, or a macromodel of fewer elements");
  std::set<std::string> ours;
  for (const Subcircuit& one : subcircuits()) ours.emplace(one.name);
  for (const AmplifierModel& amplifier : circuit.amplifiers) {
    ours.insert(lower_case(amplifier.name));
    replaced_.emplace_back(subcircuit_text(amplifier), wrapper(amplifier, model));
  }
  std::istringstream lines(model.text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(".subckt")) continue;
    const std::string name = definition_of({.text = line}).name;
    if (ours.contains(name))
      refuse_model(model.file, 0, "has a sub-circuit '" + name + "', which the circuit has too",
                   "rename it");
  }
}

Simulation MacromodelSimulator::run(const std::string& deck) {
  std::string with_model = deck;
  bool any = false;
  for (const auto& [ours, theirs] : replaced_) {
    const std::size_t at = with_model.find(ours);
    if (at == std::string::npos) continue;
    with_model.replace(at, ours.size(), any ? theirs : library_ + theirs);
    any = true;
  }
  if (!any) throw std::invalid_argument("a macromodel needs a deck with the circuit's op-amps");
  return simulator_->run(with_model);
}

}  // namespace tactile_net::decks

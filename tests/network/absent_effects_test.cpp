// What a scene does not ask of its circuit leaves no element in the deck, whatever the realisation.
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

NetworkProblem three_nodes() {
  NetworkProblem three;
  three.matrix = {3, 3, {4, 1, -2, 1, 1, -2, -2, -2, 3}};
  three.right_side = {1, 0, -2};
  three.kernel = {2, 3, {1, 0, -2, 0, 2, 0}};
  three.stabiliser = {3, 3, {2, -1, 0, -1, 3, -1, 0, -1, 2}};
  three.readings = {1, -2};
  return three;
}

std::string deck(Realization one, const RealizationOptions& options) {
  std::ostringstream out;
  write_deck(out, realize(one, three_nodes(), options), {.title = "t"}, Answer::raw_file,
             one == Realization::lc ? Analysis{SingleFrequency{options.frequency}}
                                    : Analysis{DirectCurrent{}});
  return out.str();
}

/// Cards whose name begins with these letters, comments and sub-circuits' own included.
std::size_t cards(const std::string& text, const std::string& letters) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(letters, 0) == 0) ++count;
  return count;
}

struct Effect {
  std::string name;
  std::string card;  ///< what it adds: cards that begin so
  std::function<void(RealizationOptions&)> add;
};

const std::vector<Effect> effects = {
    {"bandwidth", "Ca", [](RealizationOptions& o) { o.opamp.bandwidth = 1e6; }},
    {"second pole", "Cb", [](RealizationOptions& o) { o.opamp.second_pole = 5e6; }},
    {"offset", "Vo", [](RealizationOptions& o) { o.opamp.offset = 1e-3; }},
    {"rail", "Vh", [](RealizationOptions& o) { o.opamp.rail = 12.0; }},
    {"bias current", "Ibn", [](RealizationOptions& o) { o.opamp.bias_current = 1e-9; }},
    {"common-mode rejection", "Ecp",
     [](RealizationOptions& o) { o.opamp.common_mode_rejection = 1e4; }},
    {"noise voltage", "Rn", [](RealizationOptions& o) { o.opamp.noise_voltage = 5e-9; }},
    {"noise current", "Rmn", [](RealizationOptions& o) { o.opamp.noise_current = 1e-12; }},
    {"slew", "Bg", [](RealizationOptions& o) { o.opamp.slew = 1e7; }},
    {"output resistance", "Hr", [](RealizationOptions& o) { o.opamp.output_resistance = 50.0; }},
    {"input capacitance", "Cn", [](RealizationOptions& o) { o.opamp.input_capacitance = 1e-12; }},
    {"differential capacitance", "Cd",
     [](RealizationOptions& o) { o.opamp.differential_capacitance = 1e-12; }},
    {"load capacitance", "Cl", [](RealizationOptions& o) { o.opamp.load_capacitance = 1e-12; }},
};

}  // namespace

TEST_CASE("a deck holds no element of an effect that nobody asked for", "[deck][identity]") {
  for (const Realization one : realizations) {
    CAPTURE(name(one));
    const bool amplifiers = has_amplifiers(one);
    RealizationOptions options{.scale = {.siemens = 1.0}};
    const std::string ideal = deck(one, options);
    // Of capacitors only lc has any, and they are its network.
    CHECK((cards(ideal, "C") > 0) == (one == Realization::lc));
    for (const Effect& effect : effects) CHECK(cards(ideal, effect.card + ' ') == 0);
    for (const char* card : {"D", ".model", ".tran"}) CHECK(cards(ideal, card) == 0);
    if (one != Realization::ndr) CHECK(cards(ideal, "B") == 0);

    options.opamp.gain = 1e5;
    const std::string finite = deck(one, options);
    CHECK((finite == ideal) == !amplifiers);
    options.opamp.bandwidth = 1e6;  // what the others stand on
    const std::string base = deck(one, options);
    for (const Effect& effect : effects) {
      if (effect.name == "bandwidth") continue;
      CAPTURE(effect.name);
      RealizationOptions with = options;
      effect.add(with);
      const std::string more = deck(one, with);
      if (!amplifiers) {
        CHECK(more == ideal);
        continue;
      }
      CHECK(cards(base, effect.card + ' ') == 0);
      CHECK(cards(more, effect.card + ' ') > 0);
      // Its own cards alone, and what they are wired to; never another effect's.
      for (const Effect& other : effects)
        if (other.name != effect.name)
          CHECK(cards(more, other.card + ' ') == cards(base, other.card + ' '));
    }
  }
}

TEST_CASE("1/f noise adds its two diodes to the white noise's cards; an output current nothing",
          "[deck][identity]") {
  RealizationOptions options{.opamp = {.bandwidth = 1e6, .noise_voltage = 5e-9}};
  const std::string white = deck(Realization::lattice, options);
  CHECK(cards(white, "D") == 0);
  options.opamp.output_current = 0.02;
  CHECK(deck(Realization::lattice, options) == white);
  options.opamp.noise_corner = 100.0;
  const std::string flicker = deck(Realization::lattice, options);
  for (const char* card : {"Df ", "Dg ", ".model flicker", ".model quiet"})
    CHECK(cards(flicker, card) == 1);
  for (const Effect& effect : effects)
    CHECK(cards(flicker, effect.card + ' ') == cards(white, effect.card + ' '));
}

TEST_CASE("a capacitance across resistors adds one capacitor to each, and nothing else",
          "[deck][identity]") {
  for (const Realization one : realizations) {
    CAPTURE(name(one));
    RealizationOptions options{.scale = {.siemens = 1.0}};
    const std::string ideal = deck(one, options);
    const std::size_t resistors = realize(one, three_nodes(), options).resistors.size();
    options.resistor_capacitance = 1e-13;
    const std::string across = deck(one, options);
    CHECK(cards(across, "CR") == resistors);
    std::istringstream lines(across);
    std::string without;
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("CR", 0) != 0) without += line + '\n';
    CHECK(without == ideal);
  }
}

TEST_CASE("a capacitance at the nodes adds one capacitor to each, and nothing else",
          "[deck][identity]") {
  for (const Realization one :
       {Realization::ideal, Realization::nic, Realization::rail, Realization::ndr}) {
    CAPTURE(name(one));
    RealizationOptions options{.scale = {.siemens = 1.0}};
    const std::string ideal = deck(one, options);
    options.node_capacitance = 1e-11;
    const std::string loaded = deck(one, options);
    CHECK(cards(ideal, "C") == 0);
    CHECK(cards(loaded, "C") == 3);
    std::istringstream lines(loaded);
    std::string without;
    for (std::string line; std::getline(lines, line);)
      if (line[0] != 'C') without += line + '\n';
    CHECK(without == ideal);
  }
}

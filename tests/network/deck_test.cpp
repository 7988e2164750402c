#include "tactile_net/network/deck.hpp"

#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>
#include <stdexcept>

#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/subcircuits.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

Circuit divider() {
  Circuit circuit;
  const Node a = add_node(circuit, "n0");
  circuit.outputs = {a};
  circuit.resistors = {{"R0", a, 0, 1e-3}, {"R1", a, 0, -0.25e-3}};
  circuit.sources = {{"I0", a, 1.5e-3}};
  return circuit;
}

std::string deck(const Circuit& circuit, const DeckHeader& header = {.title = "t"},
                 Answer answer = Answer::raw_file) {
  std::ostringstream out;
  write_deck(out, circuit, header, answer);
  return out.str();
}

void check_refused(const Circuit& circuit, const char* reason,
                   const DeckHeader& header = {.title = "t"}) {
  std::ostringstream out;
  CHECK_THROWS_WITH(write_deck(out, circuit, header, Answer::printed), ContainsSubstring(reason));
  CHECK(out.str().empty());
}

}  // namespace

TEST_CASE("three elements make this deck, to the letter", "[deck]") {
  CHECK(deck(divider(), {.title = "divider", .comments = {"by hand"}, .expected = {2.0}}) ==
        "* divider\n"
        "* by hand\n"
        "* expect n0 2\n"
        "R0 n0 0 1000\n"
        "R1 n0 0 -4000\n"
        "I0 0 n0 DC 0.0015\n"
        ".op\n"
        ".end\n");
}

TEST_CASE("only comments to other simulators make ngspice print the answer", "[deck]") {
  const std::string plain = deck(divider());
  const std::string printed = deck(divider(), {.title = "t"}, Answer::printed);
  REQUIRE(printed.substr(0, plain.size()) == plain);
  CHECK(printed.substr(plain.size()) == "*# set numdgt=17\n*# run\n*# print v(n0)\n*# quit 0\n");
}

TEST_CASE("a nic brings its sub-circuits, each once, and its cards", "[deck]") {
  const std::vector<double> current{1.0, 0.0, 0.0};
  const std::string text = deck(nic(conductances({3, 3, {4, 1, -2, 1, 1, -2, -2, -2, 3}}), current,
                                    {.scale = {.siemens = 1.0}}));
  std::string expected = "* t\n";
  expected += subcircuit_text({.name = "opamp"});
  for (const char* one : {"floating_nic", "grounded_nic"}) expected += subcircuit(one).text;
  expected +=
      "Ra0_1 n0 a0_1 1\n"
      "Rb0_1 n1 b0_1 1\n"
      "R0_2 n0 n2 0.5\n"
      "R1_2 n1 n2 0.5\n"
      "Rg0 n0 0 0.3333333333333333\n"
      "Rg2 n2 g2 1\n"
      "Xf0_1 n0 n1 a0_1 b0_1 floating_nic\n"
      "Xg2 n2 g2 grounded_nic\n"
      "I0 0 n0 DC 1\n"
      "I1 0 n1 DC 0\n"
      "I2 0 n2 DC 0\n"
      ".op\n"
      ".end\n";
  CHECK(text == expected);
}

TEST_CASE("every number reads back as the same double", "[deck][property]") {
  std::mt19937_64 generator(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const double mantissa = 1.0 + std::ldexp(static_cast<double>(generator() >> 12), -52);
    const double value = std::ldexp(mantissa, static_cast<int>(generator() % 1800) - 900);
    Circuit circuit = divider();
    circuit.sources[0].ampere = value;
    const std::string text = deck(circuit);
    const std::size_t at = text.find(" DC ") + 4;
    CHECK(std::strtod(text.c_str() + at, nullptr) == value);
  }
}

TEST_CASE("a bad circuit is refused by the element's name, and nothing is written", "[deck]") {
  Circuit circuit = divider();
  circuit.resistors[1].siemens = 0.0;
  check_refused(circuit, "element R1: its conductance");
  circuit.resistors[1].siemens = 1e-320;
  check_refused(circuit, "element R1: its conductance");
  circuit.resistors[1].siemens = std::nan("");
  check_refused(circuit, "element R1: its conductance");

  circuit = divider();
  circuit.resistors[1].to = 7;
  check_refused(circuit, "element R1: a node does not exist");
  circuit = divider();
  circuit.resistors[1].name = "R0";
  check_refused(circuit, "element R0: the name stands twice");
  circuit = divider();
  circuit.sources[0].ampere = INFINITY;
  check_refused(circuit, "element I0");
  circuit = divider();
  circuit.instances = {{"X0", {1}, "floating_nic"}};
  check_refused(circuit, "element X0: its pins");
  circuit.instances = {{"X0", {1}, "nonsense"}};
  check_refused(circuit, "there is no sub-circuit 'nonsense'");
  circuit = divider();
  circuit.outputs = {9};
  check_refused(circuit, "an output is not a node");
}

TEST_CASE("a header cannot smuggle a card into the deck", "[deck]") {
  check_refused(divider(), "line break", {.title = "t\nV1 n0 0 1"});
  check_refused(divider(), "line break", {.title = "t", .comments = {"c\rV1 n0 0 1"}});
  check_refused(divider(), "one expected voltage per output", {.title = "t", .expected = {1, 2}});
}

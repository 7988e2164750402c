#include "tactile_net/network/deck.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/network/dialect_deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/subcircuits.hpp"
#include "tests/catch.hpp"
#include "tests/network/opamps.hpp"

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

/// Of elements, nodes apart: simulators know no case, and each sub-circuit has names of its own.
std::optional<std::string> name_that_stands_twice(const std::string& deck) {
  std::set<std::pair<std::string, std::string>> seen;  // each in its sub-circuit
  std::string inside;
  std::istringstream lines(deck);
  std::string line;
  std::getline(lines, line);  // the title
  while (std::getline(lines, line)) {
    for (char& one : line) one = static_cast<char>(std::tolower(static_cast<unsigned char>(one)));
    std::istringstream words(line);
    std::string first;
    std::string second;
    words >> first >> second;
    if (first == ".subckt") inside = second;
    if (first == ".ends") inside.clear();
    if (std::isalpha(static_cast<unsigned char>(first[0])) == 0) continue;
    if (!seen.emplace(inside, first).second) return first + " of '" + inside + "'";
  }
  return std::nullopt;
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

TEST_CASE("what makes ngspice print the answer stands behind the end", "[deck]") {
  const std::string plain = deck(divider());
  const std::string printed = deck(divider(), {.title = "t"}, Answer::printed);
  REQUIRE(printed.substr(0, plain.size()) == plain);
  REQUIRE(plain.substr(plain.size() - 6) == "\n.end\n");
  CHECK(printed.substr(plain.size()) ==
        ".control\nset numdgt=17\nrun\nprint v(n0)\nquit 0\n.endc\n");
}

TEST_CASE("every output is printed once, in lines that ngspice takes", "[deck]") {
  Circuit circuit = divider();
  for (int node = 1; node < 1200; ++node) {
    circuit.outputs.push_back(add_node(circuit, "n" + std::to_string(node)));
    circuit.resistors.push_back({"Rn" + std::to_string(node), circuit.outputs.back(), 0, 1e-3});
  }
  const std::string text = deck(circuit, {.title = "t"}, Answer::printed);
  std::istringstream lines(text.substr(text.find(".control\n")));
  std::vector<std::string> printed;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word != "print") continue;
    std::size_t of_line = 0;
    for (; words >> word; ++of_line) printed.push_back(word);
    CHECK(of_line < 1000);
  }
  std::vector<std::string> outputs;
  for (const std::string& node : output_names(circuit)) outputs.push_back("v(" + node + ")");
  CHECK(printed == outputs);
}

TEST_CASE("a nic brings its sub-circuits, each once, and its cards", "[deck]") {
  const NetworkProblem problem{.matrix = {3, 3, {4, 1, -2, 1, 1, -2, -2, -2, 3}},
                               .right_side = {1.0, 0.0, 0.0}};
  const std::string text = deck(realize(Realization::nic, problem, {.scale = {.siemens = 1.0}}));
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

TEST_CASE("every other realisation of three nodes, to the letter", "[deck]") {
  NetworkProblem three;
  three.matrix = {3, 3, {4, 1, -2, 1, 1, -2, -2, -2, 3}};
  three.right_side = {1, 0, -2};
  three.kernel = {2, 3, {1, 0, -2, 0, 2, 0}};
  three.stabiliser = {3, 3, {2, -1, 0, -1, 3, -1, 0, -1, 2}};
  three.readings = {1, -2};
  const auto cards = [&](Realization one, bool inverters) {
    const RealizationOptions options{.scale = {.siemens = 1.0},
                                     .inverters = inverters,
                                     .residual_gain = 2.0,
                                     .divider = 4.0,
                                     .frequency = 1.0};
    std::ostringstream out;
    write_deck(out, realize(one, three, options), {.title = "t"}, Answer::raw_file,
               one == Realization::lc ? Analysis{SingleFrequency{1.0}} : Analysis{DirectCurrent{}});
    const std::string text = out.str();
    const std::size_t last = text.rfind(".ends");
    return last == std::string::npos ? text.substr(4) : text.substr(text.find('\n', last) + 1);
  };
  CHECK(cards(Realization::rail, false) ==
        "Ra0_1 n0 r1 1\n"
        "Rb0_1 n1 r0 1\n"
        "R0_2 n0 n2 0.5\n"
        "R1_2 n1 n2 0.5\n"
        "Rg0 n0 0 1.3333333333333333\n"
        "Rg1 n1 g1 0.4444444444444444\n"
        "Rg2 n2 g2 1\n"
        "Xr0 n0 r0 inverter r=4\n"
        "Xr1 n1 r1 inverter r=4\n"
        "Xg1 n1 g1 grounded_nic r=4\n"
        "Xg2 n2 g2 grounded_nic r=4\n"
        "I0 0 n0 DC 1\n"
        "I1 0 n1 DC 0\n"
        "I2 0 n2 DC -2\n"
        ".op\n"
        ".end\n");
  CHECK(cards(Realization::crossbar, false) ==
        "R0_0 n0 s0 0.25\n"
        "R0_1 n1 s0 1\n"
        "R0_2 r2 s0 0.5\n"
        "R1_0 n0 s1 1\n"
        "R1_1 n1 s1 1\n"
        "R1_2 r2 s1 0.5\n"
        "R2_0 r0 s2 0.5\n"
        "R2_1 r1 s2 0.5\n"
        "R2_2 n2 s2 0.3333333333333333\n"
        "Xn0 0 s0 n0 r0 amplifier\n"
        "Xn1 0 s1 n1 r1 amplifier\n"
        "Xn2 0 s2 n2 r2 amplifier\n"
        "I0 0 s0 DC -1\n"
        "I1 0 s1 DC 0\n"
        "I2 0 s2 DC 2\n"
        ".op\n"
        ".end\n");
  CHECK(cards(Realization::crossbar, true) ==
        "R0_0 n0 s0 0.25\n"
        "R0_1 n1 s0 1\n"
        "R0_2 r2 s0 0.5\n"
        "R1_0 n0 s1 1\n"
        "R1_1 n1 s1 1\n"
        "R1_2 r2 s1 0.5\n"
        "R2_0 r0 s2 0.5\n"
        "R2_1 r1 s2 0.5\n"
        "R2_2 n2 s2 0.3333333333333333\n"
        "Xn0 0 s0 n0 opamp\n"
        "Xr0 n0 r0 inverter r=4\n"
        "Xn1 0 s1 n1 opamp\n"
        "Xr1 n1 r1 inverter r=4\n"
        "Xn2 0 s2 n2 opamp\n"
        "Xr2 n2 r2 inverter r=4\n"
        "I0 0 s0 DC -1\n"
        "I1 0 s1 DC 0\n"
        "I2 0 s2 DC 2\n"
        ".op\n"
        ".end\n");
  CHECK(cards(Realization::least_squares, false) ==
        "Rk0_0 n0 t0 0.5\n"
        "Rt0_0 q0 s0 0.5\n"
        "Rk0_2 r2 t0 0.25\n"
        "Rt0_2 e0 s2 0.25\n"
        "Re0 e0 t0 0.5\n"
        "Rk1_1 n1 t1 0.25\n"
        "Rt1_1 q1 s1 0.25\n"
        "Re1 e1 t1 0.5\n"
        "Rs0_0 n0 s0 0.25\n"
        "Rs0_1 r1 s0 0.5\n"
        "Rs1_0 r0 s1 0.5\n"
        "Rs1_1 n1 s1 0.16666666666666666\n"
        "Rs1_2 r2 s1 0.5\n"
        "Rs2_1 r1 s2 0.5\n"
        "Rs2_2 n2 s2 0.25\n"
        "Xn0 0 s0 n0 r0 amplifier\n"
        "Xn1 0 s1 n1 r1 amplifier\n"
        "Xn2 0 s2 n2 r2 amplifier\n"
        "Xe0 0 t0 e0 q0 amplifier\n"
        "Xe1 0 t1 e1 q1 amplifier\n"
        "I0 0 t0 DC -2\n"
        "I1 0 t1 DC 4\n"
        ".op\n"
        ".end\n");
  CHECK(cards(Realization::lc, false) ==
        "C0_2 n0 n2 0.3183098861837907\n"
        "C1_2 n1 n2 0.3183098861837907\n"
        "Cg0 n0 0 0.477464829275686\n"
        "L0_1 n0 n1 0.15915494309189535\n"
        "Lg2 n2 0 0.15915494309189535\n"
        "I0 0 n0 AC 1 90\n"
        "I1 0 n1 AC 0 90\n"
        "I2 0 n2 AC -2 90\n"
        ".options noopac\n"
        ".ac lin 1 1 1\n"
        ".end\n");
  CHECK(cards(Realization::ndr, false) ==
        "R0_2 n0 n2 0.5\n"
        "R1_2 n1 n2 0.5\n"
        "Rg0 n0 0 0.3333333333333333\n"
        "B0_1 n0 n1 I=100*((2+V(n0,n1)/100)*exp(-V(n0,n1)/100)-2)\n"
        "Bg2 n2 0 I=100*((2+V(n2,0)/100)*exp(-V(n2,0)/100)-2)\n"
        "I0 0 n0 DC 1\n"
        "I1 0 n1 DC 0\n"
        "I2 0 n2 DC -2\n"
        ".op\n"
        ".end\n");
}

TEST_CASE("a step response's deck holds the step, its time and the outputs alone", "[deck]") {
  Circuit circuit = divider();
  circuit.capacitors = {{"C0", circuit.outputs[0], 0, 1e-9}};
  std::ostringstream out;
  write_deck(out, circuit, {.title = "t"}, Answer::raw_file,
             StepResponse{.step = 1e-8, .stop = 1e-5});
  CHECK(out.str() ==
        "* t\n"
        "R0 n0 0 1000\n"
        "R1 n0 0 -4000\n"
        "C0 n0 0 1e-09\n"
        "I0 0 n0 PWL(0 0 1.0000000000000001e-11 0.0015)\n"
        ".options method=trap reltol=1e-5 chgtol=1e-18 abstol=1e-15 vntol=1e-9\n"
        ".tran 1e-08 1e-05 0 1e-08\n"
        ".save v(n0)\n"
        ".end\n");
  CHECK_THROWS_AS(write_deck(out, circuit, {.title = "t"}, Answer::raw_file,
                             StepResponse{.step = 1e-5, .stop = 1e-5}),
                  std::invalid_argument);
  CHECK_THROWS_AS(write_deck(out, circuit, {.title = "t"}, Answer::raw_file, SingleFrequency{0.0}),
                  std::invalid_argument);
}

TEST_CASE("an op-amp's sub-circuit holds what is asked for, and nothing else", "[opamp]") {
  const auto text = [](const OpAmp& opamp, Outputs outputs = Outputs::single) {
    const std::string all = subcircuit_text({"opamp", opamp, outputs});
    return all.substr(all.find(".subckt"));
  };
  CHECK(text({}) == ".subckt opamp p n out\nVn p n 0\nH1 out 0 Vn 1e21\n.ends opamp\n");
  CHECK(text({.gain = 1e5}) == ".subckt opamp p n out\nE1 out 0 p n 1e+05\n.ends opamp\n");
  CHECK(text({.gain = 1e5, .offset = 1e-3}) ==
        ".subckt opamp p n out\nVo q p 0.001\nE1 out 0 q n 1e+05\n.ends opamp\n");
  CHECK_THAT(text({.gain = 1e5, .bandwidth = 1e6}),
             ContainsSubstring("Ca x 0 1.5915494309189535e-10\nE1 out 0 x 0 1\n") &&
                 !ContainsSubstring("Gb") && !ContainsSubstring("D"));
  CHECK_THAT(text({.gain = 1e5, .bandwidth = 1e6, .second_pole = 1e6}),
             ContainsSubstring("Cb y 0 1.5915494309189535e-07\nE1 out 0 y 0 1\n"));
  CHECK_THAT(text({.gain = 1e5, .rail = 12.0}),
             ContainsSubstring("Vh h 0 11.4\n") && !ContainsSubstring("Ca "));
  CHECK_THAT(text({.gain = 1e5, .input_capacitance = 1e-12}), ContainsSubstring("Cn n 0 1e-12\n"));
  CHECK_THAT(text({.gain = 1e5, .differential_capacitance = 1e-12, .load_capacitance = 2e-12},
                  Outputs::complementary),
             ContainsSubstring("Cd p n 1e-12\nCl out 0 2e-12\nCi inv 0 2e-12\n"));
  CHECK_THAT(text({}, Outputs::complementary),
             StartsWith(".subckt opamp p n out inv\n") && ContainsSubstring("E2 inv 0 0 out 1\n"));
  CHECK_THROWS_AS(text({.gain = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(text({.second_pole = 1e6}), std::invalid_argument);
  CHECK_THROWS_AS(text({.rail = 0.5}), std::invalid_argument);
  CHECK_THROWS_AS(text({.differential_capacitance = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(text({.load_capacitance = -1e-12}), std::invalid_argument);
}

TEST_CASE("no name stands twice in a deck or a sub-circuit, of any set of an op-amp's keys",
          "[deck][opamp]") {
  const NetworkProblem two{.matrix = {2, 2, {2, -1, -1, 2}}, .right_side = {1.0, 0.0}};
  for (unsigned set = 0; set < 1U << further_keys.size(); ++set) {
    const OpAmp opamp = opamp_with(set);
    for (const Realization one : {Realization::nic, Realization::crossbar}) {
      const std::optional<std::string> twice =
          name_that_stands_twice(deck(realize(one, two, {.opamp = opamp})));
      if (!twice) continue;
      FAIL_CHECK(name(one) << ", set " << set << ": " << *twice << " stands twice");
      return;
    }
  }
}

TEST_CASE("names that a simulator would take for one, or for a card, are refused", "[deck]") {
  Circuit circuit = divider();
  circuit.resistors[1].name = "r0";
  check_refused(circuit, "element r0: the name stands twice");
  for (const char* name : {"", "R0 n0 0 1", "R2\nV1", "R=3"}) {
    circuit.resistors[1].name = name;
    check_refused(circuit, "one word");
  }
  for (const char* name : {"N0", "0", "GND"}) {
    circuit = divider();
    (void)add_node(circuit, name);
    check_refused(circuit, "another node of the circuit has that name");
  }
  for (const char* name : {"", "n1 n2", "n1\n.end", "v(n1)"}) {
    circuit = divider();
    (void)add_node(circuit, name);
    check_refused(circuit, "a node's name must be one word");
  }
}

TEST_CASE("an element is what its name begins with", "[deck]") {
  const auto renamed = [](const std::function<void(Circuit&)>& rename) {
    Circuit circuit = divider();
    circuit.capacitors = {{"C0", 1, 0, 1e-9}};
    circuit.inductors = {{"L0", 1, 0, 1e-9}};
    circuit.devices = {{"B0", 1, 0, 1e-3}};
    circuit.amplifiers = {{"opamp", one_pole, Outputs::single}};
    (void)add_node(circuit, "n1");
    circuit.instances = {{"X0", {0, 1, 2}, "opamp"}};
    rename(circuit);
    return circuit;
  };
  CHECK_FALSE(deck(renamed([](Circuit&) {})).empty());
  const char* const rule = "by which simulators know what it is";
  check_refused(renamed([](Circuit& c) { c.resistors[0].name = "V0"; }), rule);
  check_refused(renamed([](Circuit& c) { c.capacitors[0].name = ".end"; }), rule);
  check_refused(renamed([](Circuit& c) { c.inductors[0].name = "R9"; }), rule);
  check_refused(renamed([](Circuit& c) { c.devices[0].name = "R9"; }), rule);
  check_refused(renamed([](Circuit& c) { c.sources[0].name = "V0"; }), rule);
  check_refused(renamed([](Circuit& c) { c.instances[0].name = "R9"; }), rule);
}

TEST_CASE("sub-circuits of one name, or of what is no name, are refused", "[deck]") {
  Circuit circuit = divider();
  for (const char* name : {"", "a b", "a\n.end"}) {
    circuit.amplifiers = {{name, one_pole, Outputs::single}};
    check_refused(circuit, "a model's name must be one word");
  }
  for (const char* name : {"opamp", "OpAmp", "inverter"}) {
    circuit.amplifiers = {{"opamp", one_pole, Outputs::single}, {name, {}, Outputs::single}};
    check_refused(circuit, "another sub-circuit has that name");
  }
}

TEST_CASE("what a form of a deck adds collides with nothing", "[deck][dialect]") {
  NetworkProblem problem{
      .matrix = {2, 2, {1, 2, 2, 5}}, .right_side = {1.0, 0.0}, .names = {"n0", "n1"}};
  std::ostringstream out;
  const auto ltspice = [&] {
    write_deck(out, realize(Realization::lc, problem), {.title = "t"}, Answer::raw_file,
               SingleFrequency{1e4}, {.dialect = Dialect::ltspice});
  };
  const auto opened = [&] {
    write_subcircuit(out, realize(Realization::nic, problem), {.title = "t"}, "pad");
  };
  CHECK_NOTHROW(ltspice());
  CHECK_NOTHROW(opened());
  out.str("");
  problem.names[1] = "mL0_1";  // between an inductor and its resistor
  CHECK_THROWS_WITH(ltspice(), ContainsSubstring("'mL0_1'"));
  problem.names[1] = "ma.Xf0_1";  // inside of a converter that is opened
  CHECK_THROWS_WITH(opened(), ContainsSubstring("'ma.Xf0_1'"));
  CHECK(out.str().empty());
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

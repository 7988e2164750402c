#include "tactile_net/network/realization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/subcircuits.hpp"
#include "tests/catch.hpp"
#include "tests/network/networks.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

/// P with one positive entry off the diagonal, one negative row sum and one that is zero.
const NetworkProblem mixed{.matrix = {3, 3, {4, 1, -2, 1, 1, -2, -2, -2, 3}},
                           .right_side = {1.0, 0.0, -2.0}};

}  // namespace

TEST_CASE("ideal takes a resistor a branch, and one to ground where the row sum is not zero",
          "[ideal]") {
  const ElementCounts counts = count_elements(realize(Realization::ideal, mixed));
  CHECK(conductances(mixed.matrix).ground == std::vector<double>{3.0, 0.0, -1.0});
  CHECK(counts.resistors == 5);
  CHECK(counts.negative_resistors == 2);
  CHECK(counts.opamps == 0);
  CHECK(counts.sources == 3);
}

TEST_CASE("nic takes two op-amps a negative branch, one a negative row sum, no negative resistor",
          "[nic]") {
  const ElementCounts counts = count_elements(realize(Realization::nic, mixed));
  CHECK(counts.opamps == 3);
  CHECK(counts.negative_resistors == 0);
  CHECK(counts.resistors == 2 + 1 + (2 + 3) + (1 + 2));  // branches, ground, floating, grounded
}

TEST_CASE("siemens and volts scale conductances and currents", "[realization]") {
  const Circuit circuit =
      realize(Realization::ideal, mixed, {.scale = {.siemens = 2e-3, .volts = 0.5}});
  CHECK(circuit.resistors[1].siemens == 2e-3 * 2.0);
  CHECK(circuit.sources[2].ampere == -2.0 * 2e-3 * 0.5);
}

TEST_CASE("realisations are found by the names they have", "[realization]") {
  for (const Realization one : realizations) CHECK(realization_named(name(one)) == one);
  CHECK_FALSE(realization_named("nics"));
}

TEST_CASE("every realisation has a row of its own, which says what it is", "[realization]") {
  for (const Realization one : realizations) {
    CAPTURE(name(one));
    const RealizationTraits& said = traits(one);
    CHECK(said.realization == one);
    CHECK_FALSE(said.theorem.name.empty());
    CHECK(said.theorem_with_inverters.name.empty() != said.drives_nodes);
    CHECK((said.bandwidth_ratio != nullptr) == said.drives_nodes);
    const Circuit circuit = realize(one, array_network(5, 1e-3).problem);
    CHECK((count_elements(circuit).opamps > 0) == said.uses_opamps);
    if (said.linear())
      CHECK_NOTHROW(Reduction(circuit));
    else
      CHECK_THROWS_AS(Reduction(circuit), std::invalid_argument);
  }
}

TEST_CASE("what is only rounding becomes no resistor", "[realization][property]") {
  // On a slipping layer one quantity does not answer to every taxel; dead ones leave rows of zeros.
  const SensorArray array{9, 0.3, {0.4, 1.1}, {Quantity::shear_xy}};
  const Material pad{2.0, 0.3, Layer{1.1, Base::frictionless}};
  const LinearProblem inverse =
      make_problem(array, pad, {.unknowns = 2, .smoothing_length = 0.4, .dead_taxels = {0, 4}});
  const std::vector<double> readings(18, 0.25);
  const NetworkProblem problem = network_problem(inverse, 3e-4, readings);
  for (const Realization one :
       {Realization::nic, Realization::rail, Realization::crossbar, Realization::least_squares}) {
    CAPTURE(name(one));
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (const Resistor& r : realize(one, problem).resistors) {
      least = std::min(least, r.siemens);
      largest = std::max(largest, r.siemens);
    }
    CHECK(least > 1e-13 * largest);
  }
}

TEST_CASE("currents and scales that make no circuit are refused", "[realization]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Realization one : {Realization::ideal, Realization::nic, Realization::rail,
                                Realization::crossbar, Realization::lc, Realization::ndr}) {
    CAPTURE(name(one));
    NetworkProblem bad = mixed;
    bad.right_side = {1.0};
    CHECK_THROWS_AS(realize(one, bad), std::invalid_argument);
    bad.right_side = {1.0, nan, 0.0};
    CHECK_THROWS_AS(realize(one, bad), std::invalid_argument);
  }
  CHECK_THROWS_AS(realize(Realization::ideal, mixed, {.scale = {.siemens = 0.0}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(realize(Realization::ideal, mixed, {.scale = {.volts = -1.0}}),
                  std::invalid_argument);
}

TEST_CASE("names that simulators would read as another node or card are refused",
          "[realization][deck]") {
  const ArrayNetwork network = array_network(3, 1e-3);
  const auto refuses = [](Realization one, const NetworkProblem& problem, const std::string& says) {
    CAPTURE(name(one), says);
    CHECK_THROWS_WITH(realize(one, problem), ContainsSubstring(says));
    CHECK_THROWS_AS(realize(one, problem), std::invalid_argument);
  };
  const auto named = [&](const char* name) {
    NetworkProblem problem = network.problem;
    problem.names = {name, "n1", "n2"};
    return problem;
  };
  for (const Realization one : realizations) {
    for (const char* bad : {"n2", "N1", "0", "gnd", "", "n 0", "n\t0", "n\n0", "n0\nR9 n0 0 1",
                            "n;0", "n(0)", "n=0", "n\xc3\xa9", "$n0", "//n0", "n0#branch"})
      refuses(one, named(bad), "is named");
    refuses(one, named("n\nR9"), "'n\\x0aR9'");
    CHECK(realize(one, named("p_0.1")).nodes[realize(one, named("p_0.1")).outputs[0]] == "p_0.1");
  }
  // Nodes that a realisation has besides.
  refuses(Realization::crossbar, named("s0"), "'s0'");
  refuses(Realization::crossbar, named("R2"), "'r2'");
  refuses(Realization::least_squares, named("e0"), "'e0'");
  refuses(Realization::lattice, named("u1"), "'u1'");
  // Nodes that a simulator makes inside of sub-circuits.
  refuses(Realization::crossbar, named("xN0.x"), "inside of the element xN0");
  refuses(Realization::rail, named("Xr1.Xa.x"), "inside of the element Xr1");
  CHECK_NOTHROW(realize(Realization::ideal, named("Xn0.x")));
  CHECK_NOTHROW(realize(Realization::ideal, named("s0")));

  // The deck sees to circuits that others made.
  Circuit circuit = realize(Realization::ideal, network.problem);
  circuit.nodes[1] = "n2";
  std::ostringstream deck;
  CHECK_THROWS_AS(write_deck(deck, circuit, {.title = "t"}, Answer::raw_file),
                  std::invalid_argument);
  CHECK(deck.str().empty());
}

TEST_CASE("what is said of a sub-circuit is what its text holds", "[subcircuits]") {
  for (const Subcircuit& one : subcircuits()) {
    CAPTURE(one.name);
    std::istringstream lines{std::string(one.text)};
    bool found = false;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string first;
      std::string word;
      words >> first;
      std::size_t count = 0;
      while (words >> word) ++count;
      if (first == ".subckt") {
        found = true;
        CHECK(count == one.pins + 2);  // its name and r=
        CHECK(line.find(".subckt " + std::string(one.name) + " ") == 0);
      }
      if (first[0] == 'R') CHECK(word == "{r}");
      if (first[0] == 'X') CHECK(word == "opamp");
    }
    CHECK(found);
  }
  CHECK_THROWS_WITH(subcircuit("opamp"), ContainsSubstring("there is no sub-circuit 'opamp'"));
}

#include "tactile_net/network/dialect.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tactile_net/network/dialect_deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

Analysis analysis_of(Realization realization) {
  if (realization == Realization::lc) return SingleFrequency{1e4};
  return DirectCurrent{};
}

std::string deck(Realization realization, Dialect dialect, Curve curve = Curve::cubic) {
  RealizationOptions options;
  options.curve = curve;
  options.divider = 2e4;
  options.inverters = true;
  std::ostringstream out;
  write_deck(out, realize(realization, array_network(7, 1e-3).problem, options), {.title = "t"},
             Answer::printed, analysis_of(realization), {.dialect = dialect});
  return out.str();
}

void check_refused(Dialect dialect, const std::string& card, const char* why) {
  CAPTURE(card);
  CHECK_THROWS_WITH(check_dialect("* title\n" + card + "\n", dialect),
                    ContainsSubstring("line 2") && ContainsSubstring(why));
}

}  // namespace

TEST_CASE("every realisation makes a deck of every dialect that keeps its rules", "[dialect]") {
  for (const Realization one : realizations)
    for (const Dialect dialect : dialects)
      for (const Curve curve : {Curve::cubic, Curve::tunnel_diode}) {
        CAPTURE(name(one), name(dialect));
        CHECK_NOTHROW(check_dialect(deck(one, dialect, curve), dialect));
      }
}

TEST_CASE("op-amps as they are sold, and a ladder, make decks of every dialect", "[dialect]") {
  for (const Realization one : realizations)
    for (const bool ladder : {false, true}) {
      if (!traits(one).uses_opamps || (ladder && !has_ladder(one, {.ladder = true}))) continue;
      for (const OpAmpClass& sold : opamp_classes())
        for (const Dialect dialect : dialects) {
          CAPTURE(name(one), ladder, sold.name, name(dialect));
          std::ostringstream out;
          const Circuit circuit =
              realize(one, array_network(7, 1e-3).problem, {.opamp = sold.opamp, .ladder = ladder});
          CHECK_NOTHROW(write_deck(out, circuit, {.title = "t"}, Answer::printed,
                                   StepResponse{.step = 1e-8, .stop = 1e-5}, {.dialect = dialect}));
          const std::string text = out.str();
          CHECK_THAT(text,
                     ContainsSubstring(dialect == Dialect::xyce ? "\nBg 0 x I={" : "\nBg 0 x I="));
          CHECK(std::count(text.begin(), text.end(), '{') ==
                std::count(text.begin(), text.end(), '}'));
        }
    }
}

TEST_CASE("a deck of another dialect breaks the rules that they differ by", "[dialect]") {
  CHECK_THROWS_WITH(check_dialect(deck(Realization::lc, Dialect::ngspice), Dialect::ltspice),
                    ContainsSubstring("noopac"));
  CHECK_THROWS_WITH(check_dialect(deck(Realization::ndr, Dialect::ltspice), Dialect::xyce),
                    ContainsSubstring("braces"));
  CHECK_THROWS_WITH(check_dialect(deck(Realization::nic, Dialect::ngspice), Dialect::xyce),
                    ContainsSubstring("PARAMS:"));
  CHECK_THROWS_WITH(check_dialect(deck(Realization::ideal, Dialect::ngspice), Dialect::ltspice),
                    ContainsSubstring("negative"));
  CHECK_THROWS_WITH(check_dialect(deck(Realization::crossbar, Dialect::ngspice), Dialect::xyce),
                    ContainsSubstring("PARAMS:"));
}

TEST_CASE("each rule names the line and what to do", "[dialect]") {
  check_refused(Dialect::ngspice, "B1 a 0 I=V(a)^3", "write the product");
  check_refused(Dialect::ltspice, ".options noopac", "ngspice alone");
  check_refused(Dialect::xyce, ".options reltol=1e-5", "package");
  check_refused(Dialect::xyce, ".save v(a)", ".print");
  check_refused(Dialect::xyce, ".subckt x a r=1", "PARAMS:");
  check_refused(Dialect::xyce, "X1 a x r=1", "PARAMS:");
  check_refused(Dialect::xyce, "B1 a 0 I=V(a)", "braces");
  check_refused(Dialect::ltspice, "R1 a 0 -10", "negative resistors");
  CHECK_THROWS_WITH(check_dialect("* t\nR1 a 0 1\n.op\n", Dialect::xyce),
                    ContainsSubstring("no result"));
  CHECK_NOTHROW(check_dialect("* t\n* B1 a 0 I=V(a)^3\nR1 a 0 1 ; ^\n.op\n", Dialect::ltspice));
}

TEST_CASE("what differs between dialects is there, and nothing else", "[dialect]") {
  const std::string xyce = deck(Realization::nic, Dialect::xyce);
  CHECK_THAT(xyce, ContainsSubstring(" PARAMS: r=10000\n") &&
                       ContainsSubstring(" PARAMS: r=20000\n") && ContainsSubstring(".dc I0 ") &&
                       ContainsSubstring(".print dc v(n0) v(n1)") && !ContainsSubstring("*#"));
  const std::string lossless = deck(Realization::lc, Dialect::ltspice);
  CHECK_THAT(lossless, !ContainsSubstring("noopac") && ContainsSubstring("0.001\n"));
  std::ostringstream out;
  Circuit circuit = resistor_and_capacitor();
  circuit.resistors[0].siemens = -1e-3;
  write_deck(out, circuit, {.title = "t"}, Answer::raw_file, DirectCurrent{},
             {.dialect = Dialect::ltspice});
  CHECK_THAT(out.str(), ContainsSubstring(std::string(negative_resistors_untested)));
}

TEST_CASE("parts' tolerances are comments behind their values", "[dialect]") {
  std::ostringstream out;
  const std::vector<SoldPart> parts = {{1020.0, 0.001}};
  write_deck(out, resistor_and_capacitor(), {.title = "t"}, Answer::raw_file, DirectCurrent{},
             {.parts = parts});
  CHECK_THAT(out.str(), ContainsSubstring("\nR0 n0 0 1020 ; 0.1 %\n"));
  const std::vector<SoldPart> many(2, parts[0]);
  CHECK_THROWS_AS(write_deck(out, resistor_and_capacitor(), {.title = "t"}, Answer::raw_file,
                             DirectCurrent{}, {.parts = many}),
                  std::invalid_argument);
}

TEST_CASE("a sub-circuit has pins for the readings and the outputs, and a symbol of them",
          "[dialect]") {
  const Circuit circuit = realize(Realization::lattice, array_network(3, 1e-3).problem);
  const std::vector<Node> pins = ports(circuit);
  CHECK(pins.size() == 2 * 3 + 3);
  std::ostringstream out;
  write_subcircuit(out, circuit, {.title = "t"}, "pad");
  CHECK_THAT(out.str(), ContainsSubstring("\n.subckt pad u0 v0 u1 v1 u2 v2 n0 n1 n2\n") &&
                            EndsWith(".ends pad\n") && !ContainsSubstring("\nI"));
  std::ostringstream symbol;
  write_symbol(symbol, circuit, "pad", "pad.lib");
  CHECK_THAT(symbol.str(), StartsWith("Version 4\nSymbolType BLOCK\n") &&
                               ContainsSubstring("SYMATTR ModelFile pad.lib\n") &&
                               ContainsSubstring("PINATTR PinName n2\nPINATTR SpiceOrder 9\n"));
  CHECK_THROWS_AS(write_subcircuit(out, circuit, {.title = "t"}, "two words"),
                  std::invalid_argument);
  // One that is inside it, whatever its case.
  for (const char* inside : {"amplifier", "AMPLIFIER"}) {
    std::ostringstream nothing;
    CHECK_THROWS_WITH(write_subcircuit(nothing, circuit, {.title = "t"}, inside),
                      ContainsSubstring("must not be 'amplifier'"));
    CHECK(nothing.str().empty());
    CHECK_THROWS_AS(write_symbol(nothing, circuit, inside, "a.lib"), std::invalid_argument);
  }
  // A node that takes a current and is an output is one pin.
  CHECK(ports(realize(Realization::ideal, array_network(3, 1e-3).problem)).size() == 3);
}

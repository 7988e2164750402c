// The parts of circuits/parts on the board: each pin has the net that its data sheet asks for.
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/network/board.hpp"
#include "tactile_net/network/laid_board.hpp"
#include "tactile_net/scene/opamp_part.hpp"
#include "tests/catch.hpp"
#include "tests/network/board_laws.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

SolderedCircuit soldered_for(const AmplifierPackage& package, Outputs outputs) {
  const Realization realization =
      outputs == Outputs::complementary ? Realization::lattice : Realization::nic;
  const FlatCircuit circuit(realize(realization, array_network(5, 1e-3).problem, {}));
  const PartChoice choice(Reduction(circuit), Series::e96);
  const std::vector<PartValue> values = choice.values(std::vector<bool>(choice.groups().size()));
  SolderedCircuit built = soldered(circuit, values, std::vector<double>(values.size(), 0.01));
  built.amplifiers = package;
  return built;
}

LaidBoard laid_board(const SolderedCircuit& built) {
  std::ostringstream text;
  write_kicad_board(text, board_of(built));
  return read_kicad_board(text.str(), "board.kicad_pcb");
}

}  // namespace

TEST_CASE("every pin of every part has the net that its data sheet asks for", "[board]") {
  for (const OpAmpPart& sold : opamp_parts()) {
    CAPTURE(sold.name, sold.package);
    const AmplifierPins& pins = sold.pins;
    const SolderedCircuit built = soldered_for(sold.packaged(), sold.outputs);
    const LaidBoard board = laid_board(built);
    CHECK_NOTHROW(check_same_circuit(board, built.circuit, built.amplifiers));
    CHECK(board_laws::nets_apart(board) == std::set<std::string>{});
    CHECK(board_laws::too_near(board) == std::vector<std::string>{});
    std::map<std::string, const LaidBoard::Part*> parts;
    for (const LaidBoard::Part& part : board.parts) parts[part.element] = &part;
    REQUIRE_FALSE(built.circuit.instances.empty());
    std::map<std::string, std::set<std::string>> idle;  // pads by their nets
    for (const Instance& x : built.circuit.instances) {
      CAPTURE(x.name);
      std::map<int, std::string> wanted;
      const auto node = [&](std::size_t k) {
        return x.pins.at(k) == 0 ? std::string("GND") : built.circuit.nodes[x.pins[k]];
      };
      wanted[pins.in_plus[0]] = node(0);
      wanted[pins.in_minus[0]] = node(1);
      wanted[pins.out_plus[0]] = node(2);
      if (sold.outputs == Outputs::complementary) wanted[pins.out_minus[0]] = node(3);
      for (const int pin : pins.supply_plus) wanted[pin] = "VCC";
      for (const int pin : pins.supply_minus) wanted[pin] = "VEE";
      for (const int pin : pins.common_mode) wanted[pin] = "GND";
      for (const int pin : pins.power_down) wanted[pin] = "VCC";
      for (const int pin : pins.exposed) wanted[pin] = "GND";
      if (pins.amplifiers() == 2) {
        wanted[pins.in_plus[1]] = "GND";
        wanted[pins.in_minus[1]] = wanted[pins.out_plus[1]] = "idle1" + x.name;
      }
      const LaidBoard::Part& part = *parts.at(x.name);
      const int count = std::stoi(sold.package.substr(sold.package.find_last_of('-') + 1));
      CHECK(part.pads.size() == static_cast<std::size_t>(count) + pins.exposed.size());
      std::set<std::string> names;
      for (const LaidBoard::Pad& pad : part.pads) {
        CAPTURE(pad.name);
        CHECK(names.insert(pad.name).second);
        const auto known = wanted.find(std::stoi(pad.name));
        CHECK(board.nets[pad.net] == (known == wanted.end() ? "" : known->second));
      }
      for (const auto& [pin, net] : wanted) CHECK(names.contains(std::to_string(pin)));
    }
    // A follower's net joins its two pins, and nothing else.
    for (const LaidBoard::Part& part : board.parts)
      for (const LaidBoard::Pad& pad : part.pads)
        if (board.nets[pad.net].starts_with("idle"))
          idle[board.nets[pad.net]].insert(part.element + '.' + pad.name);
    CHECK(idle.size() == (pins.amplifiers() == 2 ? built.circuit.instances.size() : 0));
    for (const auto& [net, pads] : idle) CHECK(pads.size() == 2);
  }
}

TEST_CASE("a board of one part is refused where the scene names one with other pins",
          "[board][bad]") {
  const auto packaged = [](std::string_view name) {
    for (const OpAmpPart& one : opamp_parts())
      if (one.name == name) return one.packaged();
    FAIL("no such part");
    return AmplifierPackage{};
  };
  const SolderedCircuit built = soldered_for(packaged("THS4541"), Outputs::complementary);
  const LaidBoard board = laid_board(built);
  CHECK_THROWS_WITH(check_same_circuit(board, built.circuit, packaged("THS4551")),
                    ContainsSubstring("at pad 8"));
  CHECK_THROWS_WITH(check_same_circuit(board, built.circuit, packaged("OPA192")),
                    ContainsSubstring("OPA192") && ContainsSubstring("one output"));
  CHECK_THROWS_WITH(board_of(soldered_for(packaged("OPA192"), Outputs::complementary)),
                    ContainsSubstring("OPA192"));
  AmplifierPackage strange = packaged("THS4551");
  strange.name = "DIP-8";
  CHECK_THROWS_WITH(
      board_of(soldered_for(strange, Outputs::complementary)),
      ContainsSubstring("THS4551") && ContainsSubstring("DIP-8") && ContainsSubstring("VSSOP-8"));
}

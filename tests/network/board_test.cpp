#include "tactile_net/network/board.hpp"

#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

/// A list of atoms and lists in brackets.
struct Expression {
  std::string atom{};
  std::vector<Expression> list{};

  [[nodiscard]] const std::string& head() const { return list.at(0).atom; }
  [[nodiscard]] std::vector<const Expression*> all(const std::string& name) const {
    std::vector<const Expression*> found;
    for (const Expression& one : list)
      if (!one.list.empty() && one.head() == name) found.push_back(&one);
    return found;
  }
};

Expression read(std::istream& in) {
  Expression result;
  char c = 0;
  while (in.get(c)) {
    if (c == '(') {
      result.list.push_back(read(in));
    } else if (c == ')') {
      return result;
    } else if (c == '"') {
      Expression text;
      while (in.get(c) && c != '"') {
        if (c == '\\') in.get(c);
        text.atom += c;
      }
      result.list.push_back(text);
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      Expression word;
      word.atom = c;
      while (in.peek() != ')' && in.peek() != EOF && std::isspace(in.peek()) == 0)
        word.atom += static_cast<char>(in.get());
      result.list.push_back(word);
    }
  }
  return result;
}

using Pads = std::map<std::string, std::string>;  // a pad's net, by its name

/// Footprints' pads by their reference, of the file's text alone.
std::map<std::string, Pads> pads_in(const std::string& file) {
  std::istringstream in(file);
  const Expression board = read(in).list.at(0);
  REQUIRE(board.head() == "kicad_pcb");
  std::map<std::string, std::string> nets;
  for (const Expression* net : board.all("net")) nets[net->list.at(1).atom] = net->list.at(2).atom;
  std::map<std::string, Pads> result;
  for (const Expression* footprint : board.all("footprint")) {
    std::string reference;
    for (const Expression* text : footprint->all("fp_text"))
      if (text->list.at(1).atom == "reference") reference = text->list.at(2).atom;
    CHECK_FALSE(result.contains(reference));
    for (const Expression* pad : footprint->all("pad")) {
      const auto net = pad->all("net");
      std::string name;
      if (!net.empty()) {
        name = net[0]->list.at(2).atom;
        CHECK(nets.at(net[0]->list.at(1).atom) == name);
      }
      result[reference][pad->list.at(1).atom] = name;
    }
  }
  return result;
}

SolderedCircuit soldered_network(Realization realization, bool pairs, bool inverters = false) {
  RealizationOptions options;
  options.inverters = inverters;
  const Circuit wanted = realize(realization, array_network(9, 1e-3).problem, options);
  const FlatCircuit circuit(wanted);
  const PartChoice choice(Reduction(wanted), Series::e96);
  const std::vector<PartValue> values =
      choice.values(std::vector<bool>(choice.groups().size(), pairs));
  std::vector<double> tolerances(values.size(), 0.01);
  tolerances.back() = 0.001;
  return soldered(circuit, values, tolerances);
}

std::string file_of(const Board& board) {
  std::ostringstream out;
  write_kicad_board(out, board);
  return out.str();
}

std::string net_of(const Circuit& circuit, Node node) {
  return node == 0 ? "GND" : circuit.nodes[node];
}

}  // namespace

TEST_CASE("every pad of the board has the net that the deck's node is", "[board]") {
  for (const Realization one : {Realization::crossbar, Realization::least_squares,
                                Realization::lattice, Realization::nic, Realization::rail})
    for (const bool pairs : {false, true}) {
      CAPTURE(name(one), pairs);
      const SolderedCircuit built = soldered_network(one, pairs);
      const Circuit& circuit = built.circuit;
      std::map<std::string, Pads> pads = pads_in(file_of(board_of(built)));
      std::size_t known = 0;
      for (const Resistor& r : circuit.resistors) {
        CAPTURE(r.name);
        CHECK(pads.at(r.name) ==
              Pads{{"1", net_of(circuit, r.from)}, {"2", net_of(circuit, r.to)}});
        ++known;
      }
      for (const Instance& x : circuit.instances) {
        CAPTURE(x.name);
        const Pads& own = pads.at(x.name);
        REQUIRE(own.size() == 8);
        const bool both = x.pins.size() == 4;
        CHECK(own.at(both ? "8" : "3") == net_of(circuit, x.pins[0]));
        CHECK(own.at(both ? "1" : "2") == net_of(circuit, x.pins[1]));
        CHECK(own.at(both ? "4" : "6") == net_of(circuit, x.pins[2]));
        if (both) CHECK(own.at("5") == net_of(circuit, x.pins[3]));
        CHECK(own.at(both ? "3" : "7") == "VCC");
        CHECK(own.at(both ? "6" : "4") == "VEE");
        ++known;
      }
      for (const CurrentSource& i : circuit.sources) {
        CHECK(pads.at("J" + i.name).at("1") == net_of(circuit, i.into));
        ++known;
      }
      CHECK(pads.size() == known + circuit.outputs.size() + 3);
    }
}

TEST_CASE("nothing stands upon another part, or beyond the board's edge", "[board]") {
  const Board board = board_of(soldered_network(Realization::lattice, true));
  std::vector<const BoardPad*> pads;
  struct Box {
    double left, right, top, bottom;
  };
  std::vector<Box> boxes;
  for (const Footprint& one : board.footprints) {
    Box box{1e9, -1e9, 1e9, -1e9};
    for (const BoardPad& pad : one.pads) {
      box.left = std::min(box.left, one.x + pad.x - 0.5 * pad.width);
      box.right = std::max(box.right, one.x + pad.x + 0.5 * pad.width);
      box.top = std::min(box.top, one.y + pad.y - 0.5 * pad.height);
      box.bottom = std::max(box.bottom, one.y + pad.y + 0.5 * pad.height);
    }
    CHECK((box.left > 0.0 && box.right < board.width));
    CHECK((box.top > 0.0 && box.bottom < board.height));
    boxes.push_back(box);
  }
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      const bool apart = boxes[a].right < boxes[b].left || boxes[b].right < boxes[a].left ||
                         boxes[a].bottom < boxes[b].top || boxes[b].bottom < boxes[a].top;
      if (!apart) FAIL(board.footprints[a].reference << " on " << board.footprints[b].reference);
    }
}

TEST_CASE("better parts are larger and say so; entries stand in rows and columns", "[board]") {
  const Board board = board_of(soldered_network(Realization::crossbar, false));
  std::map<std::string, const Footprint*> by_name;
  std::set<std::string> kinds;
  for (const Footprint& one : board.footprints) {
    by_name[one.reference] = &one;
    if (one.tolerance == "0.1 %") kinds.insert(one.library);
  }
  CHECK(kinds == std::set<std::string>{"Resistor_SMD:R_0603_1608Metric"});
  CHECK(by_name.at("R2_3")->x == by_name.at("R5_3")->x);
  CHECK(by_name.at("R2_3")->y == by_name.at("R2_7")->y);
  CHECK(by_name.at("R2_3")->x < by_name.at("R2_4")->x);
  CHECK(by_name.at("R2_3")->tolerance == "1 %");
  CHECK(file_of(board) == file_of(board));
}

TEST_CASE("a board is of resistors and op-amps", "[board]") {
  SolderedCircuit built = soldered_network(Realization::crossbar, false);
  built.circuit.inductors.push_back({"L1", 1, 0, 1.0});
  CHECK_THROWS_AS(board_of(built), std::invalid_argument);
  built.circuit.inductors.clear();
  built.parts.pop_back();
  CHECK_THROWS_AS(board_of(built), std::invalid_argument);
}

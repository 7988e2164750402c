#include "tactile_net/network/board.hpp"

#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/network/laid_board.hpp"
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

/// Footprints' pads by their element, of the file's text alone.
std::map<std::string, Pads> pads_in(const std::string& file) {
  std::istringstream in(file);
  const Expression board = read(in).list.at(0);
  REQUIRE(board.head() == "kicad_pcb");
  std::map<std::string, std::string> nets;
  for (const Expression* net : board.all("net")) nets[net->list.at(1).atom] = net->list.at(2).atom;
  std::map<std::string, Pads> result;
  std::set<std::string> references;
  for (const Expression* footprint : board.all("footprint")) {
    std::string element;
    for (const Expression* property : footprint->all("property"))
      if (property->list.at(1).atom == "Element") element = property->list.at(2).atom;
    CHECK_FALSE(result.contains(element));
    for (const Expression* text : footprint->all("fp_text")) {
      if (text->list.at(1).atom != "reference") continue;
      CHECK(references.insert(text->list.at(2).atom).second);
      CHECK(text->all("layer").at(0)->list.at(1).atom ==
            (text->list.at(2).atom.front() == 'H' ? "F.Fab" : "F.SilkS"));
    }
    REQUIRE(footprint->all("fp_rect").size() == 1);
    CHECK(footprint->all("fp_rect")[0]->all("layer").at(0)->list.at(1).atom == "F.CrtYd");
    for (const Expression* pad : footprint->all("pad")) {
      const auto net = pad->all("net");
      std::string name;
      if (!net.empty()) {
        name = net[0]->list.at(2).atom;
        CHECK(nets.at(net[0]->list.at(1).atom) == name);
      }
      result[element][pad->list.at(1).atom] = name;
    }
  }
  CHECK(references.size() == result.size());
  return result;
}

/// The nets of these headers' odd or even pins, in their order; between them are pins of ground.
std::vector<std::string> signals_of(const std::map<std::string, Pads>& pads, const std::string& use,
                                    std::size_t first) {
  std::vector<std::string> signals;
  for (std::size_t k = 1; pads.contains(use + std::to_string(k)); ++k) {
    const Pads& own = pads.at(use + std::to_string(k));
    CHECK(own.size() % 2 == 0);
    CHECK(own.size() <= 40);
    for (std::size_t pin = 1; pin <= own.size(); ++pin) {
      const std::string& net = own.at(std::to_string(pin));
      if (pin % 2 == first % 2)
        signals.push_back(net);
      else
        CHECK(net == "GND");
    }
  }
  return signals;
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
        CHECK(own.at("7") == "VCC");  // supply, or power-down, active low
        if (both) CHECK(own.at("3") == "VCC");
        CHECK(own.at(both ? "6" : "4") == "VEE");
        ++known;
      }
      // A pin of each reading and output, in order, each beside one of ground.
      std::vector<std::string> readings;
      for (const CurrentSource& i : circuit.sources) readings.push_back(net_of(circuit, i.into));
      std::vector<std::string> outputs;
      for (const Node node : circuit.outputs) outputs.push_back(net_of(circuit, node));
      CHECK(signals_of(pads, "inputs", 1) == readings);
      CHECK(signals_of(pads, "outputs", 2) == outputs);
      CHECK(pads.at("supply") == Pads{{"1", "GND"}, {"2", "VCC"}, {"3", "VEE"}});
      for (const auto& [element, own] : pads)
        if (element.starts_with("inputs") || element.starts_with("outputs") || element == "supply")
          ++known;
      // Each supply of each amplifier, and each supply, has a capacitor to ground.
      for (const Instance& x : circuit.instances) {
        CHECK(pads.at("Cp" + x.name) == Pads{{"1", "VCC"}, {"2", "GND"}});
        CHECK(pads.at("Cn" + x.name) == Pads{{"1", "VEE"}, {"2", "GND"}});
      }
      CHECK(pads.at("CVCC") == Pads{{"1", "VCC"}, {"2", "GND"}});
      CHECK(pads.at("CVEE") == Pads{{"1", "VEE"}, {"2", "GND"}});
      known += 2 * circuit.instances.size() + 2;
      for (const auto& [element, own] : pads)
        if (element.starts_with("TP")) {
          CHECK(own == Pads{{"1", element.substr(2)}});
          ++known;
        }
      for (const char* screw : {"H1", "H2", "H3", "H4"}) CHECK(pads.at(screw) == Pads{{"", ""}});
      CHECK(pads.size() == known + 4);
    }
}

TEST_CASE("designators are a letter and a number, each once, in the deck's order", "[board]") {
  const SolderedCircuit built = soldered_network(Realization::crossbar, true);
  std::set<std::string> seen;
  std::size_t amplifiers = 0;
  for (const Footprint& one : board_of(built).footprints) {
    CAPTURE(one.element);
    CHECK(seen.insert(one.reference()).second);
    CHECK(one.reference().substr(one.kind == Footprint::Kind::test_point ? 2 : 1) ==
          std::to_string(one.number));
    if (one.kind == Footprint::Kind::resistor) {
      const std::size_t r = one.number - 1;
      CHECK(one.reference().front() == 'R');
      CHECK(one.element == built.circuit.resistors.at(r).name);
      // "4.99k" reads back as its ohms.
      const double unit = std::map<char, double>{{'R', 1.0}, {'k', 1e3}, {'M', 1e6}, {'G', 1e9}}.at(
          one.value.back());
      CHECK_THAT(unit * std::stod(one.value), WithinRel(built.parts.at(r).ohm, 1e-6));
    } else if (one.kind == Footprint::Kind::amplifier) {
      CHECK(one.reference().front() == 'U');
      CHECK(one.element == built.circuit.instances.at(amplifiers++).name);
      CHECK(one.value == "fully differential amplifier");
    } else if (one.kind == Footprint::Kind::capacitor) {
      CHECK(one.reference().front() == 'C');
    } else if (one.kind == Footprint::Kind::header) {
      CHECK(one.reference().front() == 'J');
    } else {
      CHECK(one.reference().front() == (one.kind == Footprint::Kind::screw ? 'H' : 'T'));
    }
  }
  CHECK(seen.contains("R" + std::to_string(built.circuit.resistors.size())));
  CHECK(amplifiers == built.circuit.instances.size());
}

TEST_CASE("a resistor's power is its own, and grows with the square of the sources", "[board]") {
  SolderedCircuit alone;
  const Node a = add_node(alone.circuit, "n0");
  alone.circuit.outputs = {a};
  alone.circuit.resistors = {{"R0", a, 0, 1e-3}, {"R1", a, 0, 3e-3}};
  alone.circuit.sources = {{"I0", a, 40e-3}};
  alone.parts = {{1e3, 0.01}, {1e3 / 3.0, 0.01}};
  alone.partner = {0, 1};
  std::size_t resistors = 0;
  for (const Footprint& one : board_of(alone).footprints) {
    if (one.kind != Footprint::Kind::resistor) continue;
    ++resistors;
    // 10 V across both.
    CHECK_THAT(one.watt, WithinRel(one.number == 1 ? 0.1 : 0.3, 1e-12));
    CHECK(one.rated_watt == 0.0625);  // an 0402
    CHECK(one.overloaded());
  }
  CHECK(resistors == 2);

  SolderedCircuit built = soldered_network(Realization::lattice, false);
  const Board weak = board_of(built);
  for (CurrentSource& source : built.circuit.sources) source.ampere *= 3.0;
  const Board strong = board_of(built);
  for (std::size_t k = 0; k < weak.footprints.size(); ++k)
    CHECK_THAT(strong.footprints[k].watt, WithinRel(9.0 * weak.footprints[k].watt, 1e-6) ||
                                              WithinAbs(9.0 * weak.footprints[k].watt, 1e-15));
}

TEST_CASE("nothing stands upon another part, or beyond the board's edge", "[board]") {
  const Board board = board_of(soldered_network(Realization::lattice, true));
  struct Box {
    double left, right, top, bottom;
  };
  std::vector<Box> boxes;
  for (const Footprint& one : board.footprints) {
    // Its courtyard, and right of it room for the designator.
    const bool upright = one.angle == 90.0 || one.angle == 270.0;
    const double x = 0.5 * (upright ? one.height : one.width);
    const double y = 0.5 * (upright ? one.width : one.height);
    // Of a header it stands left.
    const bool left = one.kind == Footprint::Kind::header;
    const bool beside = !left && one.kind != Footprint::Kind::screw;
    const Box box{one.x - x - (left ? 0.89 : 0.0), one.x + x + (beside ? 0.89 : 0.0), one.y - y,
                  one.y + y};
    for (const BoardPad& pad : one.pads) {
      CHECK(std::abs(pad.x) + 0.5 * pad.width < 0.5 * one.width);
      CHECK(std::abs(pad.y) + 0.5 * pad.height < 0.5 * one.height);
    }
    CHECK((box.left > 0.0 && box.right < board.width));
    CHECK((box.top > 0.0 && box.bottom < board.height));
    boxes.push_back(box);
  }
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      const bool apart = boxes[a].right < boxes[b].left || boxes[b].right < boxes[a].left ||
                         boxes[a].bottom < boxes[b].top || boxes[b].bottom < boxes[a].top;
      if (!apart) FAIL(board.footprints[a].element << " on " << board.footprints[b].element);
    }
}

TEST_CASE("better parts are larger and say so", "[board]") {
  const Board board = board_of(soldered_network(Realization::crossbar, false));
  std::map<std::string, const Footprint*> by_name;
  std::set<std::string> kinds;
  for (const Footprint& one : board.footprints) {
    by_name[one.element] = &one;
    if (one.tolerance == "0.1 %") kinds.insert(one.library);
  }
  CHECK(kinds == std::set<std::string>{"Resistor_SMD:R_0603_1608Metric"});
  CHECK(by_name.at("R2_3")->tolerance == "1 %");
  CHECK(file_of(board) == file_of(board));
}

TEST_CASE("a machine places parts where the board's file has their pads", "[board]") {
  const Board board = board_of(soldered_network(Realization::lattice, true));
  const LaidBoard laid = read_kicad_board(file_of(board), "board.kicad_pcb");
  std::map<std::string, const LaidBoard::Part*> parts;
  for (const LaidBoard::Part& one : laid.parts) parts[one.reference] = &one;
  std::ostringstream out;
  write_positions(out, board);
  std::istringstream lines(out.str());
  std::string line;
  std::getline(lines, line);
  CHECK(line == "Designator,Val,Package,Mid X,Mid Y,Rotation,Layer");
  std::size_t placed = 0;
  while (std::getline(lines, line)) {
    CAPTURE(line);
    std::vector<std::string> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    REQUIRE(row.size() == 7);
    const LaidBoard::Part& part = *parts.at(row[0]);
    CHECK(row[1] == part.value);
    CHECK(row[6] == "top");
    // Every package has its origin in the middle of its pads, and pin 1 to the left of it.
    double x = 0.0;
    double y = 0.0;
    for (const LaidBoard::Pad& pad : part.pads) {
      x += pad.x / static_cast<double>(part.pads.size());
      y += pad.y / static_cast<double>(part.pads.size());
    }
    CHECK_THAT(std::stod(row[3]), WithinAbs(x, 1e-6));
    CHECK_THAT(std::stod(row[4]), WithinAbs(-y, 1e-6));
    const double turn = std::stod(row[5]) * std::numbers::pi / 180.0;
    const double back_x =
        (part.pads[0].x - x) * std::cos(turn) - (part.pads[0].y - y) * std::sin(turn);
    CHECK(back_x < -0.1);
    ++placed;
  }
  std::size_t bought = 0;
  for (const Footprint& one : board.footprints)
    if (one.is_bought() && one.kind != Footprint::Kind::header) ++bought;
  CHECK(placed == bought);
}

TEST_CASE("a board is of resistors and op-amps", "[board]") {
  SolderedCircuit built = soldered_network(Realization::crossbar, false);
  built.circuit.inductors.push_back({"L1", 1, 0, 1.0});
  CHECK_THROWS_AS(board_of(built), std::invalid_argument);
  built.circuit.inductors.clear();
  built.parts.pop_back();
  CHECK_THROWS_AS(board_of(built), std::invalid_argument);
}

TEST_CASE("a node that is named as another net of the board is refused", "[board]") {
  for (const char* name : {"VCC", "vee", "GND", "n1", "N1"}) {
    CAPTURE(name);
    SolderedCircuit built = soldered_network(Realization::crossbar, false);
    built.circuit.nodes[built.circuit.outputs[0]] = name;
    CHECK_THROWS_WITH(board_of(built), ContainsSubstring("name"));
  }
}

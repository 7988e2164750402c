#include "tactile_net/network/board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "network/nodal_equations.hpp"
#include "network/node_names.hpp"
#include "network/package_lands.hpp"
#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr double margin = 5.0;  // [mm], between blocks and to the edge

/// A resistor's courtyard and pads, and what it carries at 70 degrees.
struct Chip {
  const char* library;
  double width, height;
  double pad_x, pad_width, pad_height;
  double watt;
};
constexpr Chip chip_0402{"Resistor_SMD:R_0402_1005Metric", 1.86, 0.94, 0.51, 0.54, 0.64, 0.0625};
constexpr Chip chip_0603{"Resistor_SMD:R_0603_1608Metric", 2.96, 1.46, 0.825, 0.8, 0.95, 0.1};

constexpr double gap = 0.3;              // between courtyards of a row
constexpr double designator_room = 1.0;  // above a courtyard

constexpr double pin_width = 2.4;
constexpr double pin_pitch = 2.54;

/// With a letter, always: assemblers do not take a bare number for ohms.
std::string in_ohm(double ohm) {
  constexpr std::array<std::pair<double, const char*>, 4> units = {
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, "R"}}};
  for (const auto& [unit, letter] : units)
    if (ohm >= unit) {
      // Three or four digits: what dividing adds beyond them is no part of the value.
      double value = 0.0;
      (void)read_number(shortest(std::round(ohm / unit * 1e6) / 1e6), value);
      return shortest(value) + letter;
    }
  return shortest(ohm) + 'R';
}

/// Of every resistor, as the circuit's sources drive it [W].
std::vector<double> watts_of(const Circuit& circuit) {
  const FlatCircuit flat(circuit);
  const Eigen::VectorXd volts = NodalEquations(flat).voltages();
  std::vector<double> watts;
  for (const Resistor& r : circuit.resistors)
    watts.push_back(r.siemens * std::pow(volts(static_cast<Eigen::Index>(r.from)) -
                                             volts(static_cast<Eigen::Index>(r.to)),
                                         2));
  return watts;
}

/// Puts footprints on the board, block under block.
class Layout {
 public:
  explicit Layout(const SolderedCircuit& soldered)
      : soldered_(soldered), circuit_(soldered.circuit) {
    if (!circuit_.inductors.empty() || !circuit_.devices.empty())
      throw std::invalid_argument("a board is of resistors and op-amps alone");
    if (soldered.parts.size() != circuit_.resistors.size())
      throw std::invalid_argument("a board needs a value and a tolerance of every resistor");
    check_node_names(circuit_);
    for (Node node = 1; node < circuit_.nodes.size(); ++node)
      if (const std::string name = in_lower_case(circuit_.nodes[node]);
          name == "vcc" || name == "vee")
        throw std::invalid_argument("node " + std::to_string(node) + " is named '" +
                                    circuit_.nodes[node] +
                                    "': a board's supply has the nets VCC and VEE; give the node "
                                    "another name");
    board_.nets = {"", "GND"};
    board_.nets.insert(board_.nets.end(), circuit_.nodes.begin() + 1, circuit_.nodes.end());
    positive_ = board_.nets.size();
    board_.nets.insert(board_.nets.end(), {"VCC", "VEE"});
    for (const SoldPart& part : soldered.parts) coarsest_ = std::max(coarsest_, part.tolerance);
    for (const SoldPart& part : soldered.parts) pitch_ = std::max(pitch_, chip(part).width + gap);
    watts_ = watts_of(circuit_);
  }

  Board board() && {
    std::vector<std::size_t> entries;
    std::vector<std::size_t> stabiliser;
    for (std::size_t r = 0; r < circuit_.resistors.size(); ++r) {
      const bool apart = place_of(circuit_.resistors[r].name).array == Array::stabiliser;
      (apart ? stabiliser : entries).push_back(r);
    }
    add_grid(entries, false);
    add_grid(stabiliser, true);
    board_.width = std::max(board_.width, 100.0);
    add_amplifiers();
    add_pins();
    return std::move(board_);
  }

 private:
  [[nodiscard]] static std::size_t net(Node node) { return node + 1; }
  [[nodiscard]] const Chip& chip(const SoldPart& part) const {
    return part.tolerance < coarsest_ ? chip_0603 : chip_0402;
  }

  /// With what stands above it.
  [[nodiscard]] double room(std::size_t r) const {
    return designator_room + chip(soldered_.parts[r]).height;
  }

  /// Resistors in the cells of their entries, one above the other.
  /// @param packed  cells of a column move up, since most of a band's rows are empty
  void add_grid(const std::vector<std::size_t>& resistors, bool packed) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> cells;
    for (const std::size_t r : resistors) {
      const ResistorPlace place = place_of(circuit_.resistors[r].name);
      cells[{packed ? 0 : place.row, place.column}].push_back(r);
    }
    std::map<std::size_t, double> heights;  // of rows
    for (const auto& [cell, list] : cells) {
      double height = 0.0;
      for (const std::size_t r : list) height += room(r);
      heights[cell.first] = std::max(heights[cell.first], height);
    }
    std::map<std::size_t, double> tops;
    for (const auto& [row, height] : heights) {
      tops[row] = below_;
      below_ += height + 0.4;
    }
    for (const auto& [cell, list] : cells) {
      double y = tops[cell.first];
      for (const std::size_t r : list) {
        y += room(r);
        add_resistor(r, margin + pitch_ * (static_cast<double>(cell.second) + 0.5),
                     y - 0.5 * chip(soldered_.parts[r]).height);
      }
      board_.width =
          std::max(board_.width, 2.0 * margin + pitch_ * static_cast<double>(cell.second + 1));
    }
    if (!resistors.empty()) below_ += margin;
  }

  void add_resistor(std::size_t r, double x, double y) {
    const Resistor& one = circuit_.resistors[r];
    const SoldPart& part = soldered_.parts[r];
    const Chip& kind = chip(part);
    board_.footprints.push_back(
        {.kind = Footprint::Kind::resistor,
         .library = kind.library,
         .number = r + 1,
         .element = one.name,
         .value = in_ohm(part.ohm),
         .tolerance = percent(part.tolerance),
         .watt = watts_[r],
         .rated_watt = kind.watt,
         .x = x,
         .y = y,
         .width = kind.width,
         .height = kind.height,
         .pads = {{"1", -kind.pad_x, 0.0, kind.pad_width, kind.pad_height, net(one.from)},
                  {"2", kind.pad_x, 0.0, kind.pad_width, kind.pad_height, net(one.to)}}});
  }

  /// From a supply to ground, so that it holds its voltage where it is taken.
  void add_capacitor(const std::string& element, const char* value, const Chip& kind,
                     std::size_t at, double x, double y) {
    board_.footprints.push_back(
        {.kind = Footprint::Kind::capacitor,
         .library = &kind == &chip_0402 ? "Capacitor_SMD:C_0402_1005Metric"
                                        : "Capacitor_SMD:C_0603_1608Metric",
         .number = ++capacitors_,
         .element = element,
         .value = value,
         .x = x,
         .y = y,
         .width = kind.width,
         .height = kind.height,
         .pads = {{"1", -kind.pad_x, 0.0, kind.pad_width, kind.pad_height, at},
                  {"2", kind.pad_x, 0.0, kind.pad_width, kind.pad_height, net(0)}}});
  }

  /// The next place of a row of equal parts, and another row where it is full.
  struct Row {
    double width, height;
    std::size_t count = 0;
  };
  std::pair<double, double> next(Row& row) const {
    const double wide = std::max(1.0, std::floor((board_.width - 2.0 * margin) / row.width));
    const auto in_row = static_cast<std::size_t>(wide);
    const std::size_t rows_before = row.count / in_row;
    const double x = margin + row.width * (static_cast<double>(row.count % in_row) + 0.5);
    const double y = below_ + row.height * (static_cast<double>(rows_before) + 0.5);
    ++row.count;
    return {x, y};
  }
  void end(const Row& row) {
    if (row.count == 0) return;
    Row last = row;
    --last.count;
    below_ = next(last).second + 0.5 * row.height + margin;
  }

  void add_amplifiers() {
    // Below each its two capacitors.
    constexpr double below_it = designator_room + chip_0402.height;
    std::size_t count = 0;
    Row row{};
    for (const Instance& x : circuit_.instances) {
      Footprint part = amplifier_footprint(x);
      part.number = ++count;
      if (count == 1) row = {part.width + gap, part.height + designator_room + below_it + gap};
      std::tie(part.x, part.y) = next(row);
      part.y += 0.5 * (designator_room - below_it - gap);
      const double y = part.y + 0.5 * part.height + below_it - 0.5 * chip_0402.height;
      add_capacitor("Cp" + x.name, "100n", chip_0402, positive_, part.x - 0.25 * part.width, y);
      add_capacitor("Cn" + x.name, "100n", chip_0402, positive_ + 1, part.x + 0.25 * part.width, y);
      board_.footprints.push_back(std::move(part));
    }
    end(row);
  }

  /// With the nets of its pins.
  Footprint amplifier_footprint(const Instance& x) {
    const AmplifierModel* const model = amplifier(circuit_, x.subcircuit);
    if (model == nullptr)
      throw std::invalid_argument("element " + x.name + ": a board has no sub-circuits");
    const bool both = model->outputs == Outputs::complementary;
    const AmplifierPackage package =
        soldered_.amplifiers.value_or(AmplifierPackage::usual(model->outputs));
    if (both == package.pins.out_minus.empty())
      throw std::invalid_argument("element " + x.name + " has " +
                                  (both ? "two outputs" : "one output") + ", and " + package.part +
                                  " has not");
    if (both && package.pins.amplifiers() != 1)
      throw std::invalid_argument(package.part +
                                  " holds several fully differential amplifiers: "
                                  "take the one that holds one");
    PackageLands lands = lands_of(package);
    const auto join = [&](const std::vector<int>& pins, std::size_t at) {
      for (const int pin : pins) lands.pads.at(static_cast<std::size_t>(pin) - 1).net = at;
    };
    const AmplifierPins& pins = package.pins;
    const auto signals = {&pins.in_plus, &pins.in_minus, &pins.out_plus, &pins.out_minus};
    for (std::size_t k = 0; const std::vector<int>* const signal : signals) {
      if (k < x.pins.size()) join({signal->at(0)}, net(x.pins[k]));
      ++k;
    }
    // What the package has beside is a follower at ground.
    for (std::size_t idle = 1; idle < pins.amplifiers(); ++idle) {
      const std::size_t own = add_net("idle" + std::to_string(idle) + x.name);
      join({pins.in_plus[idle]}, net(0));
      join({pins.in_minus.at(idle), pins.out_plus.at(idle)}, own);
    }
    join(pins.supply_plus, positive_);
    join(pins.supply_minus, positive_ + 1);
    join(pins.common_mode, net(0));
    join(pins.power_down, positive_);
    join(pins.exposed, net(0));
    return {.kind = Footprint::Kind::amplifier,
            .library = std::move(lands.library),
            .element = x.name,
            .value = both ? "fully differential amplifier" : "op-amp",
            .width = lands.width,
            .height = lands.height,
            .pads = std::move(lands.pads)};
  }

  /// That no node of the circuit has.
  std::size_t add_net(const std::string& name) {
    if (std::find(board_.nets.begin(), board_.nets.end(), name) != board_.nets.end())
      throw std::invalid_argument("a node is named '" + name +
                                  "', as a net of the board is: give it another name");
    board_.nets.push_back(name);
    return board_.nets.size() - 1;
  }

  void add_pins() {
    Row row{pin_pitch, pin_pitch + designator_room};
    std::size_t count = 0;
    const auto add = [&](const std::string& element, const std::string& use, std::size_t at) {
      Footprint pin{.kind = Footprint::Kind::pin,
                    .library = "Connector_PinHeader_2.54mm:PinHeader_1x01_P2.54mm_Vertical",
                    .number = ++count,
                    .element = element,
                    .value = use + ' ' + element,
                    .width = pin_width,
                    .height = pin_width,
                    .pads = {{"1", 0.0, 0.0, 1.7, 1.7, at, true}}};
      std::tie(pin.x, pin.y) = next(row);
      pin.y += 0.5 * designator_room;
      board_.footprints.push_back(std::move(pin));
    };
    for (const CurrentSource& one : circuit_.sources) add(one.name, "reading", net(one.into));
    for (const Node node : circuit_.outputs) add(circuit_.nodes[node], "output", net(node));
    add("GND", "supply", net(0));
    add("VCC", "supply", positive_);
    add("VEE", "supply", positive_ + 1);
    end(row);
    Row large{chip_0603.width + gap, chip_0603.height + designator_room};
    for (const std::size_t supply : {positive_, positive_ + 1}) {
      const auto [x, y] = next(large);
      add_capacitor("C" + board_.nets[supply], "10u", chip_0603, supply, x,
                    y + 0.5 * designator_room);
    }
    end(large);
    board_.height = below_;
  }

  const SolderedCircuit& soldered_;
  const Circuit& circuit_;
  Board board_;
  std::vector<double> watts_;  // of resistors
  std::size_t positive_ = 0;   // net of VCC; VEE follows
  std::size_t capacitors_ = 0;
  double coarsest_ = 0.0;
  double pitch_ = 0.0;     // of columns
  double below_ = margin;  // where the next block begins
};

}  // namespace

std::string Footprint::reference() const {
  switch (kind) {
    case Kind::resistor:
      return 'R' + std::to_string(number);
    case Kind::amplifier:
      return 'U' + std::to_string(number);
    case Kind::capacitor:
      return 'C' + std::to_string(number);
    case Kind::pin:
      break;
  }
  return 'J' + std::to_string(number);
}

Board board_of(const SolderedCircuit& soldered) { return Layout(soldered).board(); }

}  // namespace tactile_net

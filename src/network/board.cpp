#include "tactile_net/network/board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "network/board_rows.hpp"
#include "network/nodal_equations.hpp"
#include "network/node_names.hpp"
#include "network/package_lands.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

/// A resistor's courtyard and pads, and what it carries at 70 degrees.
struct Chip {
  const char* library;
  double width, height;
  double pad_x, pad_width, pad_height;
  double watt;
};
constexpr Chip chip_0402{"Resistor_SMD:R_0402_1005Metric", 1.86, 0.94, 0.51, 0.54, 0.64, 0.0625};
constexpr Chip chip_0603{"Resistor_SMD:R_0603_1608Metric", 2.96, 1.46, 0.825, 0.8, 0.95, 0.1};

// Headers of pins in steps of 2.54 mm, as KiCad's library has them.
constexpr double pin_pitch = 2.54;
constexpr double pin_pad = 1.7;
constexpr double beyond_pins = 3.6;       // of courtyards, from the middles of the outer pins
constexpr std::size_t most_signals = 20;  // of a header of two rows: a cable of 40 wires
constexpr double test_point_width = 1.5;
constexpr double screw = 3.2;
constexpr double screw_head = 6.4;
constexpr double screw_from_edge = 4.0;

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

/// Makes footprints of a circuit's parts, and has them placed and joined.
class BoardOf {
 public:
  explicit BoardOf(const SolderedCircuit& soldered)
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
    parts_.ground = net(0);
    parts_.positive = board_.nets.size();
    parts_.negative = parts_.positive + 1;
    board_.nets.insert(board_.nets.end(), {"VCC", "VEE"});
    for (const SoldPart& part : soldered.parts) coarsest_ = std::max(coarsest_, part.tolerance);
    watts_ = watts_of(circuit_);
  }

  Board board() && {
    for (std::size_t r = 0; r < circuit_.resistors.size(); ++r) {
      const std::size_t other = partner_of(r);
      const bool is_second = other < r && partner_of(other) == r;
      if (!is_second) parts_.resistors.emplace_back();
      unit_of_.push_back(is_second ? unit_of_[other] : parts_.resistors.size() - 1);
      add_resistor(r);
      parts_.resistors[unit_of_[r]].push_back(board_.footprints.size() - 1);
    }
    add_amplifiers();
    add_test_points();
    add_headers();
    std::vector<BoardRow> rows = place_in_rows(board_, parts_);
    lay_tracks(board_, rows, parts_);
    add_labels(board_, rows, title());
    add_screws();
    return std::move(board_);
  }

 private:
  [[nodiscard]] static std::size_t net(Node node) { return node + 1; }
  [[nodiscard]] const Chip& chip(const SoldPart& part) const {
    return part.tolerance < coarsest_ ? chip_0603 : chip_0402;
  }

  [[nodiscard]] std::size_t partner_of(std::size_t r) const {
    return r < soldered_.partner.size() ? soldered_.partner[r] : r;
  }

  void add_resistor(std::size_t r) {
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
         .width = kind.width,
         .height = kind.height,
         .pads = {{"1", -kind.pad_x, 0.0, kind.pad_width, kind.pad_height, net(one.from)},
                  {"2", kind.pad_x, 0.0, kind.pad_width, kind.pad_height, net(one.to)}}});
  }

  /// From a supply to ground, so that it holds its voltage where it is taken.
  std::size_t add_capacitor(const std::string& element, const char* value, const Chip& kind,
                            std::size_t at) {
    board_.footprints.push_back(
        {.kind = Footprint::Kind::capacitor,
         .library = &kind == &chip_0402 ? "Capacitor_SMD:C_0402_1005Metric"
                                        : "Capacitor_SMD:C_0603_1608Metric",
         .number = ++capacitors_,
         .element = element,
         .value = value,
         .width = kind.width,
         .height = kind.height,
         .pads = {{"1", -kind.pad_x, 0.0, kind.pad_width, kind.pad_height, at},
                  {"2", kind.pad_x, 0.0, kind.pad_width, kind.pad_height, net(0)}}});
    return board_.footprints.size() - 1;
  }

  void add_amplifiers() {
    std::size_t count = 0;
    for (const Instance& x : circuit_.instances) {
      Footprint part = amplifier_footprint(x);
      part.number = ++count;
      board_.footprints.push_back(std::move(part));
      const std::size_t own = board_.footprints.size() - 1;
      parts_.amplifiers.push_back(
          {own, add_capacitor("Cp" + x.name, "100n", chip_0402, parts_.positive),
           add_capacitor("Cn" + x.name, "100n", chip_0402, parts_.negative)});
    }
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
    const auto join = [&](const std::vector<int>& pins, std::size_t at, std::string purpose) {
      for (const int pin : pins) {
        BoardPad& pad = lands.pads.at(static_cast<std::size_t>(pin) - 1);
        pad.net = at;
        pad.purpose = purpose;
      }
    };
    const AmplifierPins& pins = package.pins;
    join({pins.in_plus.at(0)}, net(x.pins[0]), "IN+");
    join({pins.in_minus.at(0)}, net(x.pins[1]), "IN-");
    join({pins.out_plus.at(0)}, net(x.pins[2]), both ? "OUT+" : "OUT");
    if (both) join({pins.out_minus.at(0)}, net(x.pins[3]), "OUT-");
    // What the package has beside is a follower at ground.
    for (std::size_t idle = 1; idle < pins.amplifiers(); ++idle) {
      const std::size_t own = add_net("idle" + std::to_string(idle) + x.name);
      const std::string which = std::to_string(idle + 1);
      join({pins.in_plus[idle]}, net(0), "IN" + which + '+');
      join({pins.in_minus.at(idle)}, own, "IN" + which + '-');
      join({pins.out_plus.at(idle)}, own, "OUT" + which);
    }
    join(pins.supply_plus, parts_.positive, "V+");
    join(pins.supply_minus, parts_.negative, "V-");
    join(pins.common_mode, net(0), "VOCM");
    join(pins.power_down, parts_.positive, "PD");
    join(pins.exposed, net(0), "EP");
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

  /// Of what amplifiers drive, and of nodes that resistors alone join: residuals.
  void add_test_points() {
    std::vector<std::size_t> resistors(circuit_.nodes.size());
    for (const Resistor& one : circuit_.resistors)
      for (const Node node : {one.from, one.to}) ++resistors[node];
    std::vector<bool> wanted(circuit_.nodes.size());
    for (Node node = 1; node < wanted.size(); ++node) wanted[node] = resistors[node] > 2;
    for (const Instance& x : circuit_.instances)
      for (std::size_t k = 0; k < x.pins.size(); ++k) wanted[x.pins[k]] = k > 1;
    std::size_t count = 0;
    for (Node node = 1; node < wanted.size(); ++node) {
      if (!wanted[node]) continue;
      board_.footprints.push_back({.kind = Footprint::Kind::test_point,
                                   .library = "TestPoint:TestPoint_Pad_1.0x1.0mm",
                                   .number = ++count,
                                   .element = "TP" + circuit_.nodes[node],
                                   .value = circuit_.nodes[node],
                                   .width = test_point_width,
                                   .height = test_point_width,
                                   .pads = {{"1", 0.0, 0.0, 1.0, 1.0, net(node)}}});
      parts_.test_points.push_back(board_.footprints.size() - 1);
    }
  }

  [[nodiscard]] std::string title() const {
    return std::to_string(circuit_.sources.size()) + " inputs, " +
           std::to_string(circuit_.outputs.size()) + " outputs, " +
           std::to_string(circuit_.resistors.size()) + " resistors, " +
           std::to_string(circuit_.instances.size()) + " amplifiers";
  }

  /// @param signals  nets, in the order of their pins
  /// @param first    whether each signal stands before its ground, or behind it
  void add_signals(const std::string& use, const std::vector<std::size_t>& signals, bool first,
                   std::vector<std::size_t>& to) {
    const std::size_t count = (signals.size() + most_signals - 1) / most_signals;
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<std::size_t> nets;
      for (std::size_t s = k * signals.size() / count; s < (k + 1) * signals.size() / count; ++s)
        for (const bool is_first : {true, false})
          nets.push_back(is_first == first ? signals[s] : parts_.ground);
      to.push_back(add_header(use + std::to_string(k + 1), nets, 2));
    }
  }

  /// Pins go along y, of two columns the odd ones left.
  std::size_t add_header(const std::string& element, const std::vector<std::size_t>& nets,
                         std::size_t columns) {
    const std::size_t rows = nets.size() / columns;
    const std::string size =
        std::to_string(columns) + 'x' + (rows < 10 ? "0" : "") + std::to_string(rows);
    const auto middle = [](std::size_t count) {
      return 0.5 * pin_pitch * static_cast<double>(count - 1);
    };
    Footprint header{
        .kind = Footprint::Kind::header,
        .library = "Connector_PinHeader_2.54mm:PinHeader_" + size + "_P2.54mm_Vertical",
        .number = ++headers_,
        .element = element,
        .value = "pin header " + size,
        .width = 2.0 * middle(columns) + beyond_pins,
        .height = 2.0 * middle(rows) + beyond_pins,
        .origin_x = -middle(columns),
        .origin_y = -middle(rows)};
    for (std::size_t pin = 0; pin < nets.size(); ++pin)
      header.pads.push_back({std::to_string(pin + 1),
                             pin_pitch * static_cast<double>(pin % columns) - middle(columns),
                             pin_pitch * static_cast<double>(pin / columns) - middle(rows), pin_pad,
                             pin_pad, nets[pin], true});
    board_.footprints.push_back(std::move(header));
    return board_.footprints.size() - 1;
  }

  void add_headers() {
    std::vector<std::size_t> readings;
    for (const CurrentSource& one : circuit_.sources) readings.push_back(net(one.into));
    add_signals("inputs", readings, true, parts_.inputs);
    std::vector<std::size_t> outputs;
    for (const Node node : circuit_.outputs) outputs.push_back(net(node));
    add_signals("outputs", outputs, false, parts_.outputs);
    parts_.outputs.push_back(
        add_header("supply", {parts_.ground, parts_.positive, parts_.negative}, 1));
    for (const std::size_t supply : {parts_.positive, parts_.negative})
      parts_.outputs.push_back(add_capacitor("C" + board_.nets[supply], "10u", chip_0603, supply));
  }

  /// In the corners.
  void add_screws() {
    std::size_t count = 0;
    for (const double x : {screw_from_edge, board_.width - screw_from_edge})
      for (const double y : {screw_from_edge, board_.height - screw_from_edge}) {
        ++count;
        board_.footprints.push_back({.kind = Footprint::Kind::screw,
                                     .library = "MountingHole:MountingHole_3.2mm_M3",
                                     .number = count,
                                     .element = "H" + std::to_string(count),
                                     .value = "M3",
                                     .x = x,
                                     .y = y,
                                     .width = screw_head,
                                     .height = screw_head,
                                     .pads = {{"", 0.0, 0.0, screw, screw, 0, true}}});
      }
  }

  const SolderedCircuit& soldered_;
  const Circuit& circuit_;
  Board board_;
  BoardFootprints parts_;
  std::vector<std::size_t> unit_of_;  // of resistors
  std::vector<double> watts_;         // of resistors
  std::size_t capacitors_ = 0;
  std::size_t headers_ = 0;
  double coarsest_ = 0.0;
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
    case Kind::test_point:
      return "TP" + std::to_string(number);
    case Kind::screw:
      return 'H' + std::to_string(number);
    case Kind::header:
      break;
  }
  return 'J' + std::to_string(number);
}

std::string Footprint::package() const { return library.substr(library.find(':') + 1); }

Board board_of(const SolderedCircuit& soldered) { return BoardOf(soldered).board(); }

}  // namespace tactile_net

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "tactile_net/network/board.hpp"
#include "tactile_net/network/laid_board.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr double most_apart = 1.0 / 6.0;  // E12 rounds by a tenth

class SameCircuit {
 public:
  SameCircuit(const LaidBoard& board, const Circuit& circuit,
              const std::optional<AmplifierPackage>& amplifiers)
      : board_(board), circuit_(circuit), amplifiers_(amplifiers) {
    for (const LaidBoard::Part& part : board.parts) {
      if (part.element.empty()) continue;
      if (!parts_.try_emplace(part.element, &part).second)
        refuse(part, "stands on the board twice");
    }
    if (parts_.empty())
      throw std::invalid_argument(
          board.file +
          ": no part has the property Element, the deck's name of it: the board was not written by "
          "tactile-net, or lost them; start from the board.kicad_pcb that is written with a "
          "budget");
  }

  void compare() {
    for (const Resistor& one : circuit_.resistors) compare(one);
    for (const Instance& one : circuit_.instances) compare(one);
    compare_readings();
    for (const auto& [element, part] : parts_)
      if ((element.front() == 'R' || element.front() == 'X') && !seen_.contains(element))
        refuse(*part, "is on the board, and not in the circuit");
  }

 private:
  /// Which pin a reading comes in by is the board's own affair.
  void compare_readings() const {
    std::set<std::string> nets;
    for (const auto& [element, part] : parts_)
      if (element.starts_with("inputs"))
        for (const LaidBoard::Pad& pad : part->pads) nets.insert(board_.nets[pad.net]);
    for (const CurrentSource& one : circuit_.sources)
      if (!nets.empty() && !nets.contains(wanted(one.into)))
        throw std::invalid_argument(board_.file + ": not the board of this circuit: the reading " +
                                    one.name + " comes in at " + wanted(one.into) +
                                    ", and no header of readings has a pin of that net");
  }

  [[noreturn]] void refuse(const LaidBoard::Part& part, const std::string& what) const {
    throw std::invalid_argument(board_.file + ':' + std::to_string(part.line) +
                                ": not the board of this circuit: " + part.reference + " (" +
                                part.element + ") " + what);
  }
  [[noreturn]] void lacks(const std::string& element) const {
    throw std::invalid_argument(board_.file + ": not the board of this circuit: " + element +
                                " of the circuit is not on it: name the realisation that the board "
                                "was made of");
  }

  [[nodiscard]] const std::string& net_of(const LaidBoard::Part& part,
                                          const std::string& pad) const {
    const std::string* found = nullptr;
    for (const LaidBoard::Pad& one : part.pads) {
      if (one.name != pad) continue;
      if (found != nullptr && *found != board_.nets[one.net])
        refuse(part, "has two nets at pad " + pad);
      found = &board_.nets[one.net];
    }
    if (found == nullptr) refuse(part, "has no pad " + pad);
    return *found;
  }

  [[nodiscard]] std::string wanted(Node node) const {
    return node == 0 ? "GND" : circuit_.nodes[node];
  }

  void expect(const LaidBoard::Part& part, const std::string& pad, Node node) {
    if (const std::string& net = net_of(part, pad); net != wanted(node))
      refuse(part, "has net '" + net + "' at pad " + pad + ", the circuit " + wanted(node));
  }

  [[nodiscard]] const LaidBoard::Part* find(const std::string& element) {
    const auto at = parts_.find(element);
    if (at == parts_.end()) return nullptr;
    seen_.insert(element);
    return at->second;
  }

  [[nodiscard]] double ohm_of(const LaidBoard::Part& part) const {
    const double ohm = resistance_of(part.value);
    if (!(ohm > 0.0)) refuse(part, "has the value '" + part.value + "', which is no resistance");
    return ohm;
  }

  void compare(const Resistor& one) {
    double ohm = 0.0;
    const LaidBoard::Part* const whole = find(one.name);
    const LaidBoard::Part* const first = find(one.name + 'a');
    const LaidBoard::Part* const second = find(one.name + 'b');
    if (whole != nullptr) {
      expect(*whole, "1", one.from);
      expect(*whole, "2", one.to);
      ohm = ohm_of(*whole);
    } else {
      if (first == nullptr || second == nullptr) lacks(one.name);
      expect(*first, "1", one.from);
      expect(*second, "2", one.to);
      const double a = ohm_of(*first);
      const double b = ohm_of(*second);
      const std::string middle = net_of(*first, "2");
      if (middle == wanted(one.to)) {
        expect(*second, "1", one.from);
        ohm = a * b / (a + b);
      } else {
        if (net_of(*second, "1") != middle || middle.empty())
          refuse(*second, "has net '" + net_of(*second, "1") + "' at pad 1, its other half '" +
                              middle + "'");
        ohm = a + b;
      }
    }
    const LaidBoard::Part& at = whole != nullptr ? *whole : *first;
    if (!(std::abs(ohm * one.siemens - 1.0) <= most_apart))
      refuse(at,
             "is " + brief(ohm) + " ohm, the circuit has " + brief(1.0 / one.siemens) +
                 " ohm: was the board made for other siemens, another alpha or other readings?");
  }

  void compare(const Instance& one) {
    const LaidBoard::Part* const part = find(one.name);
    if (part == nullptr) lacks(one.name);
    const bool both = one.pins.size() == 4;
    const AmplifierPins pins =
        amplifiers_
            .value_or(AmplifierPackage::usual(both ? Outputs::complementary : Outputs::single))
            .pins;
    if (both == pins.out_minus.empty())
      refuse(*part, "is to be a " + amplifiers_->part + ", which has " +
                        (both ? "one output" : "two outputs"));
    expect(*part, std::to_string(pins.in_plus.at(0)), one.pins[0]);
    expect(*part, std::to_string(pins.in_minus.at(0)), one.pins[1]);
    expect(*part, std::to_string(pins.out_plus.at(0)), one.pins[2]);
    if (both) expect(*part, std::to_string(pins.out_minus.at(0)), one.pins[3]);
  }

  const LaidBoard& board_;
  const Circuit& circuit_;
  const std::optional<AmplifierPackage>& amplifiers_;
  std::map<std::string, const LaidBoard::Part*> parts_;  // by their elements
  std::set<std::string> seen_;
};

}  // namespace

double resistance_of(const std::string& value) {
  static const std::map<char, double> units = {{'R', 1.0}, {'r', 1.0}, {'k', 1e3},
                                               {'K', 1e3}, {'M', 1e6}, {'G', 1e9}};
  std::string digits;
  double unit = 1.0;
  bool has_unit = false;
  for (const char one : value) {
    if (const auto known = units.find(one); known != units.end()) {
      if (has_unit) return 0.0;
      has_unit = true;
      unit = known->second;
      digits += '.';
    } else {
      digits += one;
    }
  }
  if (has_unit && digits.back() == '.') digits.pop_back();
  if (digits.empty()) return 0.0;
  double ohm = 0.0;
  return read_number(digits, ohm) && ohm > 0.0 ? unit * ohm : 0.0;
}

void check_same_circuit(const LaidBoard& board, const Circuit& circuit,
                        const std::optional<AmplifierPackage>& amplifiers) {
  SameCircuit(board, circuit, amplifiers).compare();
}

}  // namespace tactile_net

// The table of op-amps that are sold, from the files of circuits/parts.
#include <sstream>

#include "docs/figures/circuits/numbers.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/opamp_part.hpp"

namespace tactile_net::circuits {
namespace {

std::string figure_of(const OpAmpPart& part, std::string_view name, double unit) {
  for (const OpAmpPart::Figure& one : part.figures)
    if (one.name == name) return brief(one.values.front() / unit);
  return "-";
}

/// "0.005", "0.005 to 0.5" with the limit, or "to 0.2" where the limit alone is known.
std::string with_limit(const OpAmpPart& part, std::string_view name, std::string_view limit,
                       double unit) {
  const std::string typical = figure_of(part, name, unit);
  const std::string most = figure_of(part, limit, unit);
  if (most == "-") return typical;
  return (typical == "-" ? "" : typical + ' ') + "to " + most;
}

std::string listed(const std::vector<int>& pins) {
  std::string text;
  for (const int pin : pins) text += (text.empty() ? "" : ", ") + std::to_string(pin);
  return text.empty() ? "-" : text;
}

}  // namespace

std::string parts_table() {
  std::ostringstream out;
  out << "| part | gain-bandwidth, MHz | slew, V/us | noise, nV | offset, mV | bias, nA | supply, "
         "V | "
         "supply current, mA | price | package | in+ | in- | out+ | out- | V+ | V- | common mode | "
         "power-down "
         "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const OpAmpPart& part : opamp_parts()) {
    const AmplifierPins& pins = part.pins;
    out << "| " << part.name << " | " << figure_of(part, "gain_bandwidth", 1e6) << " | "
        << figure_of(part, "slew", 1e6) << " | " << figure_of(part, "noise_voltage", 1e-9) << " | "
        << with_limit(part, "offset", "offset_limit", 1e-3) << " | "
        << with_limit(part, "bias_current", "bias_limit", 1e-9) << " | "
        << (part.least_supply ? brief(*part.least_supply) + " to " + brief(*part.most_supply) : "-")
        << " | " << figure_of(part, "supply_current", 1e-3) << " | " << part.price << " | "
        << part.package;
    for (const auto* of :
         {&pins.in_plus, &pins.in_minus, &pins.out_plus, &pins.out_minus, &pins.supply_plus,
          &pins.supply_minus, &pins.common_mode, &pins.power_down})
      out << " | " << listed(*of);
    out << " |\n";
  }
  return out.str();
}

}  // namespace tactile_net::circuits

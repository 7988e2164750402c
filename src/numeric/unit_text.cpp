#include "tactile_net/numeric/unit_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

struct Prefix {
  std::string_view text;
  double size;
  double factor;  // 1 / size, exactly where that is a whole number
};

constexpr std::array prefixes = {
    Prefix{"p", 1e-12, 1e12}, Prefix{"n", 1e-9, 1e9}, Prefix{"µ", 1e-6, 1e6},
    Prefix{"m", 1e-3, 1e3},   Prefix{"", 1.0, 1.0},   Prefix{"k", 1e3, 1e-3},
    Prefix{"M", 1e6, 1e-6},   Prefix{"G", 1e9, 1e-9}, Prefix{"T", 1e12, 1e-12}};

}  // namespace

ScaledUnit scaled_unit(double largest, std::string_view unit, int digits) {
  const double size = std::abs(largest);
  // What is written as 1000 is one of the next prefix.
  const double below = 1.0 - 0.5 * std::pow(10.0, -digits);
  const bool plain = size >= 0.1 * below && size < 1e3 * below;
  if (unit.empty() || size == 0.0 || !std::isfinite(size) || plain)
    return {.label = std::string(unit)};
  const Prefix* best = prefixes.data();
  for (const Prefix& prefix : prefixes)
    if (size >= prefix.size * below) best = &prefix;
  return {.label = std::string(best->text) + std::string(unit), .factor = best->factor};
}

std::string with_unit(double number, std::string_view unit, int digits) {
  if (std::isnan(number)) return "-";
  const auto [label, factor] = scaled_unit(number, unit, digits);
  return brief(number * factor, digits) + (label.empty() ? "" : " ") + label;
}

std::string with_unit(double value, double deviation, std::string_view unit) {
  if (!std::isfinite(value)) return "-";
  const double largest = std::isfinite(deviation) ? std::max(std::abs(value), deviation) : value;
  const auto [label, factor] = scaled_unit(largest, unit);
  return plus_minus(value * factor, deviation * factor) + (label.empty() ? "" : " ") + label;
}

}  // namespace tactile_net

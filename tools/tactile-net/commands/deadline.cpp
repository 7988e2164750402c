#include "commands/deadline.hpp"

#include <cmath>
#include <string_view>
#include <utility>

#include "failure.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::tool {

double deadline_of(const std::string& text) {
  // The longest unit first: a time in "us" ends with "s" too.
  constexpr std::pair<std::string_view, double> units[] = {
      {"ns", 1e-9}, {"us", 1e-6}, {"µs", 1e-6}, {"ms", 1e-3}, {"s", 1.0}};
  std::string_view number = text;
  double scale = 1.0;
  for (const auto& [unit, seconds] : units)
    if (number.ends_with(unit)) {
      number.remove_suffix(unit.size());
      scale = seconds;
      break;
    }
  while (number.ends_with(' ')) number.remove_suffix(1);
  double value = 0.0;
  if (!read_number(number, value) || !(value > 0.0) || !std::isfinite(value))
    throw WrongUsage("--deadline",
                     "'" + text + "' is not a time > 0: write it as 100us, 1ms or 2e-5");
  return value * scale;
}

}  // namespace tactile_net::tool

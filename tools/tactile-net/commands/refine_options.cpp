#include "commands/refine_options.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <variant>

#include "failure.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::tool {
namespace {

double number_of(const std::string& key, const std::string& value) {
  double number = 0.0;
  if (!read_number(value, number))
    throw WrongUsage("--refine", key + " must be a number (got '" + value + "')");
  return number;
}

std::size_t whole_of(const std::string& key, const std::string& value) {
  const auto number = whole_number(value);
  if (!number) throw WrongUsage("--refine", key + " must be a whole number (got '" + value + "')");
  return *number;
}

RefinementStep step_of(const std::string& value) {
  std::string names;
  for (const auto& one : Enumerators<RefinementStep>::all) {
    if (one.name == value) return one.value;
    names += (names.empty() ? "" : ", ") + std::string(one.name);
  }
  throw WrongUsage("--refine", "step must be one of " + names + " (got '" + value + "')");
}

}  // namespace

RefinementOptions refine_options(const std::vector<std::string>& keys, RefinementOptions over) {
  Converters converters = over.converters.value_or(Converters{});
  std::set<std::string> given;
  for (const std::string& one : keys) {
    const std::size_t equals = one.find('=');
    const std::string key = one.substr(0, equals);
    if (!given.insert(key).second) throw WrongUsage("--refine", key + " is given twice");
    const std::string value = equals == std::string::npos ? "" : one.substr(equals + 1);
    if (key == "bits")
      converters.bits = static_cast<int>(std::min<std::size_t>(whole_of(key, value), 99));
    else if (key == "cycles")
      over.cycles = whole_of(key, value);
    else if (key == "gain")
      converters.gain = number_of(key, value);
    else if (key == "noise")
      converters.noise = number_of(key, value);
    else if (key == "conversion")
      converters.conversion = number_of(key, value);
    else if (key == "step")
      over.step = step_of(value);
    else
      throw WrongUsage("--refine", "'" + one +
                                       "' is none of bits, cycles, gain, noise, conversion and "
                                       "step with a value, such as bits=12,cycles=4");
  }
  over.converters = converters;
  try {
    check(over);
  } catch (const std::invalid_argument& wrong) {
    throw WrongUsage("--refine", wrong.what());
  }
  return over;
}

void refine_as(const std::vector<std::string>& keys, AnyScene& scene) {
  if (keys.empty()) return;
  std::visit(
      [&](auto& one) {
        one.network.refine = refine_options(keys, one.network.refine.value_or(RefinementOptions{}));
      },
      scene);
}

}  // namespace tactile_net::tool

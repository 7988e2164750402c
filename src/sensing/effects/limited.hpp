/// @file
/// How an effect says that readings were cut off.
#pragma once

#include <cstddef>
#include <string>

namespace tactile_net {

inline std::string limited_note(const std::string& effect, std::size_t limited,
                                std::size_t readings) {
  if (limited == 0) return {};
  return effect + ": " + std::to_string(limited) + " of " + std::to_string(readings) +
         " readings are cut off at the range's ends";
}

}  // namespace tactile_net

/// @file
/// Numbers in a deck. Private.
#pragma once

#include <charconv>
#include <string>

namespace tactile_net {

/// Shortest decimal text that reads back as the same number, in any locale. No SPICE suffix: `M`
/// is milli there, and `MEG` is mega.
[[nodiscard]] inline std::string deck_number(double number) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

}  // namespace tactile_net

/// @file
/// Numbers in the plan's sentences.
#pragma once

#include <cstdio>
#include <string>

namespace tactile_net {

/// Three significant digits.
inline std::string number_text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", number);
  return buffer;
}

}  // namespace tactile_net

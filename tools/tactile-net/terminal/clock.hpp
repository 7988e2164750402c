/// @file
/// The clock that the libraries are given.
#pragma once

#include <chrono>

namespace tactile_net::tool {

/// Seconds since any moment; never goes back.
[[nodiscard]] inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace tactile_net::tool

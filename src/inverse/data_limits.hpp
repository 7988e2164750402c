/// @file
/// What judges of lines and of skins ask of their limits. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {

/// The most friction that anything is sought with: where contacts within a stated limit do not
/// explain a frame, the limit itself may be what is wrong.
[[nodiscard]] inline double widest_friction(const std::optional<double>& stated) noexcept {
  return std::max(usual_friction, 2.0 * stated.value_or(0.0));
}

/// @param rows  of the problem
/// @throw std::invalid_argument  a limit is not > 0, or there is not one for each row
inline void check_limits(const DataLimits& limits, std::size_t rows) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto require = [](bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument(rule);
  };
  require(!limits.noise_rms || positive(*limits.noise_rms), "noise_rms must be > 0 and finite");
  require(!limits.friction_limit || positive(*limits.friction_limit),
          "friction_limit must be > 0 and finite");
  require(!limits.largest_traction || positive(*limits.largest_traction),
          "largest_traction must be > 0 and finite");
  require(limits.largest_readings.empty() || (limits.largest_readings.size() == rows &&
                                              std::all_of(limits.largest_readings.begin(),
                                                          limits.largest_readings.end(), positive)),
          "largest_readings needs one value > 0 per row, or none");
}

}  // namespace tactile_net

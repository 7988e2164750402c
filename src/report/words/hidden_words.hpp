/// @file
/// Private. What sensors hide, in a few words.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/sensor_choice.hpp"

namespace tactile_net::report {

/// "a, b and c"
[[nodiscard]] std::string listed(std::vector<std::string> parts);

/// All that waves hide, in a column of a table: "curl along y, z; mean of q"; empty: nothing.
[[nodiscard]] std::string hidden_in_short(const lab::SensorChoice& choice);

}  // namespace tactile_net::report

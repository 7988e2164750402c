/// @file
/// What several texts about a calibration say alike. Private.
#pragma once

#include <string>
#include <string_view>

#include "tactile_net/calibration/calibration_options.hpp"

namespace tactile_net::report {

/// "half width" of "half_width".
[[nodiscard]] std::string spoken_name(std::string_view name);

/// @param is_skin  it has two shifts
[[nodiscard]] std::string spoken_parameter(PadParameter parameter, bool is_skin);

}  // namespace tactile_net::report

/// @file
/// What several texts about a calibration say alike. Private.
#pragma once

#include <string>

#include "tactile_net/calibration/calibration_options.hpp"

namespace tactile_net::report {

/// @param is_skin  it has two shifts
[[nodiscard]] std::string spoken_parameter(PadParameter parameter, bool is_skin);

}  // namespace tactile_net::report

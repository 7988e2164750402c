/// @file
/// A calibration as JSON; the format is docs/calibration.md.
#pragma once

#include <string>

#include "tactile_net/lab/calibrate.hpp"

namespace tactile_net::report {

/// @param log  name of the log's file
[[nodiscard]] std::string calibration_json(const lab::SceneCalibration& found,
                                           const std::string& log);

}  // namespace tactile_net::report

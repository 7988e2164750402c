/// @file
/// A calibration as report.html.
#pragma once

#include <string>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/calibrate.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

/// @param log  name of the log's file
[[nodiscard]] drawing::Page calibration_html(const lab::SceneCalibration& found,
                                             const std::string& log, const Made& made = {});

}  // namespace tactile_net::pages

/// @file
/// A scene and a log of presses: what the scene should have said.
///
///     const CalibrationOptions stated = parse_calibration_options(text, file);
///     const lab::SceneCalibration found = lab::calibrate(scene, log, stated);
///     report::print_calibration(std::cout, found);
#pragma once

#include <cstddef>
#include <optional>

#include "tactile_net/calibration/next_press.hpp"
#include "tactile_net/calibration/press_fit.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

struct SceneCalibration {
  Scene scene{};  ///< the nominal one
  CalibrationOptions options{};
  PressLog log{};
  PressFit fit{};
  NextPresses next{};   ///< none where not asked for
  double spread = 0.0;  ///< of the presses' centres, first to last [m]
};

/// @throw std::invalid_argument  as `fit_presses`, and of uneven arrays
[[nodiscard]] SceneCalibration calibrate(const Scene& scene, PressLog log,
                                         const CalibrationOptions& options);

/// Fills `next`. @throw std::invalid_argument  as `next_presses`
void plan_presses(SceneCalibration& found, std::size_t count,
                  std::optional<PadParameter> target = {});

}  // namespace tactile_net::lab

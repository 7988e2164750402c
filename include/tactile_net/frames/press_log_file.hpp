/// @file
/// A log of presses on disk: CSV, a row a press (docs/calibration.md has the columns).
///
///     const frames::PressLogFile file = frames::read_press_log("log.csv", scene);
///     const PressFit fit = fit_presses({scene.sensor, scene.material}, file.log);
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/calibration/press_log.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::frames {

struct PressLogFile {
  PressLog log{};  ///< in SI where the scene has [units], through its [calibration]
  std::vector<std::string> notes{};  ///< what is odd and not wrong, a sentence each
};

/// Frames without load that noise and offsets take.
inline constexpr std::size_t least_unloaded = 20;

/// @param options  how far a stated half width may be from what the radius says
/// @throw InputError  every problem at once, with its line, the rule and what to do: no or fewer
///                    than 20 unloaded rows, no press, a column missing, a value that is no number
///                    or out of range, a press number twice, an indenter beyond the array, a
///                    reading stuck at one value, a shape that there is not
[[nodiscard]] PressLogFile read_press_log(const std::filesystem::path& path, const AnyScene& scene,
                                          const CalibrationOptions& options = {});

}  // namespace tactile_net::frames

/// @file
/// A scene's file again, with what a calibration found in place of what it stated.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/calibration/press_fit.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net {

/// number = gains * reading + offsets, of each reading in the scene's unit, and the sds.
struct SensorScale {
  std::vector<double> gains{}, gain_sds{}, offsets{}, offset_sds{};
};

/// What a fit says of the numbers that the sensor gives, through what the nominal scene's
/// [calibration] and [units] made of them before the fit.
[[nodiscard]] SensorScale sensor_scale(const AnyScene& nominal, const PressFit& fit);

/// Depth, thickness, E, nu, pitch and the crosstalk's fraction are replaced where they stand,
/// [noise] gets the measured rms, and [calibration] is written anew at the end, with what the
/// scene's own did before; everything else, comments too, stays byte for byte. What the log could
/// not identify keeps its value.
///
///     frames::write_file("calibrated.toml", calibrated_scene(text, scene, log, fit, "log.csv"));
///
/// Taxels of a file of their own stand in the scene then, one by one, with their depths: the file
/// is not changed. A skin's file stays and gets `depth_factor` beside it: the scene that is written
/// belongs into the folder of the nominal one.
///
/// @param toml   the text that `nominal` was read from
/// @param from   name of the log, for [calibration]
///
/// @throw std::invalid_argument  `taxels` shares its line with other keys
/// @throw InputError  the text is not that of a scene
[[nodiscard]] std::string calibrated_scene(std::string_view toml, const AnyScene& nominal,
                                           const PressLog& log, const PressFit& fit,
                                           std::string_view from);

/// The table [calibrate] of a scene's text: how well its values are known before presses say more.
/// Absent: the defaults. A `Scene` does not hold it: nothing but a calibration asks.
///
/// @throw InputError  as `parse_scene`, of that table
[[nodiscard]] CalibrationOptions parse_calibration_options(std::string_view toml,
                                                           const std::string& file);

/// The values are worth writing: identified, or weak.
[[nodiscard]] bool is_found(ValueVerdict verdict) noexcept;

}  // namespace tactile_net

/// @file
/// What was found on a skin, as JSON.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/lab/skin_run.hpp"
#include "tactile_net/lab/summary.hpp"

namespace tactile_net::report {

/// kind `skin_run`
[[nodiscard]] std::string experiment_json(const lab::SkinExperiment& experiment);

/// A recording of a skin: kind `simulate`.
///
/// @param columns  of the file of readings
[[nodiscard]] std::string simulate_json(const SkinScene& scene, const lab::RecordedFrames& recorded,
                                        std::span<const std::string> columns);

/// A recording solved: kind `skin_solve`. @param readings  the file of readings
[[nodiscard]] std::string recording_json(const lab::SkinRecordingAnswer& recording,
                                         const std::string& readings);

}  // namespace tactile_net::report

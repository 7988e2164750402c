/// @file
/// What the script of a recording's page draws from, as JSON.
#pragma once

#include <string>

#include "tactile_net/lab/recording.hpp"

namespace tactile_net::report {

/// What a picture of any trusted frame's tractions reaches over, bands included; 0 is within.
struct TractionRange {
  double low = 0.0;
  double high = 0.0;
};
[[nodiscard]] TractionRange traction_range(const lab::RecordingOverview& overview);

/// Numbers are base64 of little-endian 16 bit integers with the unit of one step beside them; no
/// "<" is in the text, so that it can stand inside a <script> element.
[[nodiscard]] std::string recording_json(const lab::RecordingOverview& overview);

}  // namespace tactile_net::report

/// @file
/// The frames that a recording's page shows, a row each.
#pragma once

#include <string>

#include "tactile_net/lab/recording.hpp"

namespace tactile_net::report {

/// Columns: frame, t, first, count, distrusted (of the group it stands for), verdict, alpha,
/// normal_force, tangential_force, centre with their deviations, residual, then the tractions.
/// Empty: not known.
[[nodiscard]] std::string recording_csv(const lab::RecordingOverview& overview);

}  // namespace tactile_net::report

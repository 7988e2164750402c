/// @file
/// What a controller would have said of recorded frames, as CSV.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net::report {

/// Of `solve --contacts`: forces, centre, margins and residual of a frame in SI units, NaN where
/// there is none, the cells that they are sums over, the index of the reading that is an outlier
/// (-1: none), 0 or 1 for what is true of the frame; last its status, a word.
/// @param skin    of a skin's plan; else of a line's
/// @param curved  of a curved skin: also its force, moment and centre in the sensor's axes
[[nodiscard]] std::vector<std::string> estimate_columns(bool skin, bool curved = false);
/// Of all columns but the last; all NaN where the frame has no answer.
[[nodiscard]] std::vector<double> estimate_values(const ContactEstimate& estimate, bool skin,
                                                  bool curved = false);

}  // namespace tactile_net::report

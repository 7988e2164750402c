/// @file
/// What `run` has found on a skin, as CSV.
#pragma once

#include <string>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::report {

/// readings.csv, one frame as `solve` takes it, and tractions.csv, a row per cell: y and z of its
/// middle, the tractions found, their deviations where they are known, and the true ones.
[[nodiscard]] drawing::Files run_files(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::report

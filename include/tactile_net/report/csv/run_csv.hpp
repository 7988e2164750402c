/// @file
/// What `run` simulated and found, as files of frames: `solve` reads the readings back.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"

namespace tactile_net::report {

/// readings.csv, one frame as `solve` takes it; of a line truth.csv and tractions-METHOD.csv of
/// every method with an answer, of a skin tractions.csv, a row per cell: y and z of its middle, the
/// tractions found, their deviations where they are known, and the true ones; network.cir if there
/// is a circuit.
[[nodiscard]] drawing::Files run_files(const lab::Experiment& experiment);

}  // namespace tactile_net::report

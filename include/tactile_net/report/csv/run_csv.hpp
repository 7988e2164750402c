/// @file
/// What `run` simulated and found, as files of frames: `solve` reads the readings back.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"

namespace tactile_net::report {

/// readings.csv, truth.csv, tractions-METHOD.csv of every method with an answer; network.cir if
/// there is a circuit.
[[nodiscard]] drawing::Files run_files(const lab::Experiment& experiment);

}  // namespace tactile_net::report

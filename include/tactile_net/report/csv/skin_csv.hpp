/// @file
/// What `run` has found on a skin, as CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::report {

/// readings.csv, one frame as `solve` takes it, and tractions.csv, a row per cell: y and z of its
/// middle, the tractions found, their deviations where they are known, and the true ones;
/// network.cir if there is a circuit.
[[nodiscard]] drawing::Files run_files(const lab::SkinExperiment& experiment);

/// Of every cell, "normal_3_5" of row 3 and column 5, component after component.
[[nodiscard]] std::vector<std::string> traction_columns(const SkinGrid& grid,
                                                        std::size_t components);

/// What one frame amounts to, each value with its deviation; NaN where there is none. Then whether
/// the readings can be true, as a line's recording has it (0, or 1 + the worst `DataDoubt`), and
/// alpha.
[[nodiscard]] std::vector<std::string> wrench_columns();
[[nodiscard]] std::vector<double> wrench_values(const lab::SkinAnswer& answer);

}  // namespace tactile_net::report

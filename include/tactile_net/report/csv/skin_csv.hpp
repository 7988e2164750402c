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
[[nodiscard]] std::vector<std::string> traction_columns(const SurfaceGrid& grid,
                                                        std::size_t components);

/// What one frame amounts to, each value with its deviation; NaN where there is none. Then whether
/// the readings can be true, as a line's recording has it (0, or 1 + the worst `DataDoubt`), and
/// alpha.
[[nodiscard]] std::vector<std::string> wrench_columns();
[[nodiscard]] std::vector<double> wrench_values(const lab::FrameAnswer& answer);

/// Of `solve --uncertainty`: those, before `data` also the angle of the drag to the normal [rad],
/// what is left of the friction limit, and the constant found in each channel where offsets are
/// not known, all in SI units where the scene has [units]; last the verdict, a word.
[[nodiscard]] std::vector<std::string> uncertainty_columns(const SkinScene& scene);
/// Of all columns but the last.
[[nodiscard]] std::vector<double> uncertainty_values(const lab::FrameAnswer& answer,
                                                     const SkinScene& scene);

}  // namespace tactile_net::report

/// @file
/// report.html of `run`: one self-contained file.
#pragma once

#include "experiment.hpp"
#include "figure.hpp"

namespace tactile_net::tool {

[[nodiscard]] Report report_html(const Experiment& experiment);

}  // namespace tactile_net::tool

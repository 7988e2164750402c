/// @file
/// report.html of `run`: one self-contained file.
#pragma once

#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/pages/figure.hpp"

namespace tactile_net::report {

[[nodiscard]] Report report_html(const lab::Experiment& experiment);

}  // namespace tactile_net::report

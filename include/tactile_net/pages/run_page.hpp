/// @file
/// report.html of `run`: one self-contained file.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page report_html(const lab::Experiment& experiment, const Made& made = {});

}  // namespace tactile_net::pages

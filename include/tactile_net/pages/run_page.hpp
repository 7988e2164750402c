/// @file
/// report.html of `run`: one self-contained file.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page report_html(const lab::Experiment& experiment);

}  // namespace tactile_net::pages

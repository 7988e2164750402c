/// @file
/// report.html of a sweep: errors and alphas over its axes.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/pages/made.hpp"
#include "tactile_net/sweep/merge.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page sweep_page(const sweep::Table& table, const Made& made = {});

}  // namespace tactile_net::pages

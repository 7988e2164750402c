/// @file
/// Private. The figures of a study's page: error and time, arrays of other sizes, circuits.
#pragma once

#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::pages {

/// In the sections "", "sizes", "circuits", "moving" and "forward"; some without a curve.
[[nodiscard]] std::vector<drawing::Figure> tradeoff_figures(const study::Study& study);

}  // namespace tactile_net::pages

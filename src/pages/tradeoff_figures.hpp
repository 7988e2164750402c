/// @file
/// Private. The figures of a study's page: error and time, arrays of other sizes, circuits.
#pragma once

#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::pages {

/// How circuits and loops follow contacts that move; without a curve where nothing does.
[[nodiscard]] drawing::Figure moving_figure(const study::Study& study);

/// In the sections "", "sizes", "circuits", "moving" and "forward"; some without a curve.
[[nodiscard]] std::vector<drawing::Figure> tradeoff_figures(const study::Study& study);

}  // namespace tactile_net::pages

/// @file
/// The pictures of docs/thesis.md, as SVG by gnuplot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tactile_net/drawing/plot.hpp"

namespace tactile_net::thesis {

/// SVG of every plot, in order, from one run of gnuplot: linear axes, lines.
///
/// @throw std::runtime_error  gnuplot is not installed, or failed; the text says what to do
[[nodiscard]] std::vector<std::string> draw(std::span<const drawing::Plot> plots);

}  // namespace tactile_net::thesis

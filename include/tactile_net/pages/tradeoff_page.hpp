/// @file
/// A study as a page, and as a table for a terminal.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/pages/made.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::pages {

/// The points that nothing beats, fastest first, then what failed.
[[nodiscard]] std::vector<std::vector<std::string>> front_cells(const study::Study& study);

/// What did not work, and why.
[[nodiscard]] std::vector<std::string> failures_in_words(const study::Study& study);

/// Its files are the pictures (SVG) and their data (CSV).
[[nodiscard]] drawing::Page study_html(const study::Study& study, const Made& made = {});

}  // namespace tactile_net::pages

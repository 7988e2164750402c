/// @file
/// A study as a page, and as a table for a terminal.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/tradeoff/study.hpp"
#include "tactile_net/report/pages/figure.hpp"

namespace tactile_net::report {

/// The points that nothing beats, fastest first, then what failed.
[[nodiscard]] std::vector<std::vector<std::string>> front_cells(const lab::Study& study);

/// What did not work, and why.
[[nodiscard]] std::vector<std::string> failures_in_words(const lab::Study& study);

/// Its files are the pictures (SVG) and their data (CSV).
[[nodiscard]] Report study_html(const lab::Study& study);

}  // namespace tactile_net::report

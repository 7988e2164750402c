/// @file
/// A study as a page, and as a table for a terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report.hpp"
#include "study.hpp"

namespace tactile_net::tool {

/// The points that nothing beats, fastest first, then what failed.
[[nodiscard]] std::vector<std::vector<std::string>> front_cells(const Study& study);

/// What did not work, and why.
[[nodiscard]] std::vector<std::string> failures_in_words(const Study& study);

/// The pictures as files: name and SVG. Empty, and `missing` says why, without gnuplot.
struct StudyReport {
  Report page;
  std::vector<std::pair<std::string, std::string>> pictures;
};
[[nodiscard]] StudyReport study_html(const Study& study);

}  // namespace tactile_net::tool

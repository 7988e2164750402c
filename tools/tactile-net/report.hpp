/// @file
/// report.html of `run`: one self-contained file.
#pragma once

#include <string>

#include "experiment.hpp"

namespace tactile_net::tool {

struct Report {
  std::string html;
  std::string missing;  ///< what could not be drawn and why; empty: nothing is missing
};

[[nodiscard]] Report report_html(const Experiment& experiment);

}  // namespace tactile_net::tool

/// @file
/// report.html of `run`: one self-contained file.
#pragma once

#include <string>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

/// Of a line.
[[nodiscard]] drawing::Page report_html(const lab::Experiment& experiment, const Made& made = {});

/// The page, of a line or a skin, with every file beside it but result.json: what `run` writes into
/// its folder.
/// @param by  as `Made`
[[nodiscard]] drawing::Page run_page(const lab::Experiment& experiment, const std::string& by);

}  // namespace tactile_net::pages

/// @file
/// A study as a page.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/pages/made.hpp"
#include "tactile_net/study/study.hpp"

namespace tactile_net::pages {

/// Its files are the pictures (SVG) and their data (CSV).
[[nodiscard]] drawing::Page study_html(const study::Study& study, const Made& made = {});

}  // namespace tactile_net::pages

/// @file
/// report.html of many recordings: a table with a row for each, which links to its own page.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/pages/made.hpp"
#include "tactile_net/report/recordings.hpp"

namespace tactile_net::pages {

/// With recordings.csv, the same rows. @param rows  sorted; where one has a page it is linked to
[[nodiscard]] drawing::Page report_page(report::RecordingRows rows, const AnyScene& scene,
                                        const Made& made = {});

}  // namespace tactile_net::pages

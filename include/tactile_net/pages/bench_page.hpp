/// @file
/// report.html of `bench`.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/board_bench.hpp"
#include "tactile_net/pages/made.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page bench_html(const AnyScene& scene, const lab::BoardBench& bench,
                                       const Made& made = {});

}  // namespace tactile_net::pages

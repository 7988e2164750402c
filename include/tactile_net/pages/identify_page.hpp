/// @file
/// A survey of the sensors of a line or a skin as a page: a line's has curves, a skin's a map.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/identify.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page survey_html(const Scene& scene, const lab::Survey& survey,
                                        const Made& made = {});
[[nodiscard]] drawing::Page survey_html(const SkinScene& scene, const lab::Survey& survey,
                                        const Made& made = {});

}  // namespace tactile_net::pages

/// @file
/// Private. What the pages of skins have in common.
#pragma once

#include <string>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/run.hpp"

namespace tactile_net::pages {

/// A skin's scene in words: sensor, material, contacts.
[[nodiscard]] std::string scene_html(const SkinScene& scene);

/// Of one frame whose first result has an answer: the pad in section, and the numbers.
[[nodiscard]] std::string frame_html(const lab::Experiment& experiment);

/// The page of `run` for a skin, with the files beside it.
[[nodiscard]] drawing::Page skin_run_page(const lab::Experiment& experiment, const std::string& by);

}  // namespace tactile_net::pages

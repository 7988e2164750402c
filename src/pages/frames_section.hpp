/// @file
/// Private. The frames of a recording, or one frame, on a page: places for the pictures that
/// web/frames.js draws of the data, and a table of the same in words.
#pragma once

#include <span>
#include <string>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/json/frames_json.hpp"

namespace tactile_net::pages {

/// @pre  there is a frame
[[nodiscard]] std::string frames_section(const lab::RecordingOverview& overview);

/// Of a skin. @pre  there is an answer or a truth
[[nodiscard]] std::string frames_section(const lab::Experiment& experiment);

/// Around a pad's section, which the script completes.
[[nodiscard]] std::string view_of_pad(const std::string& svg);

/// Pictures of a load alone. @param views  HTML with places for them
[[nodiscard]] std::string drawn_load(const std::string& views, const report::ShownLoad& load);

/// Tractions on a skin: a map, two sections through a cell, and a sentence for who has no script.
/// @param title  what they are. @pre  some traction is not 0
[[nodiscard]] std::string skin_load(const SkinScene& scene, const SurfaceGrid& grid,
                                    std::span<const double> tractions, const std::string& title);

}  // namespace tactile_net::pages

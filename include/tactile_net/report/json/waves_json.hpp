/// @file
/// What the script of a page (pages/web/waves.js) draws maps of waves on a skin from.
#pragma once

#include <string>

#include "tactile_net/lab/identify.hpp"

namespace tactile_net::report {

/// For each component of a traction, and each wave: how many times its ripple stands out of the
/// noise. Waves that run to either side of y are alike, and are there once.
[[nodiscard]] std::string waves_json(const SkinScene& scene, const lab::Survey& survey);

}  // namespace tactile_net::report

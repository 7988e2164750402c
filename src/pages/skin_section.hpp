/// @file
/// Private. A skin's pad in section, through the peak.
#pragma once

#include <string>

#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::pages {

/// The pad to scale, cut along y through the peak: surface, taxels, base, the true load on top, the
/// stress across the surface inside.
[[nodiscard]] std::string pad_picture(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::pages

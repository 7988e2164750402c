/// @file
/// Private. How alpha was chosen, as a figure.
#pragma once

#include <optional>
#include <string_view>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/inverse/alpha.hpp"

namespace tactile_net::pages {

/// What each rule makes least over alpha, each between 0 and 1, with its choice.
/// @param used  the rule whose alpha was taken; absent: alpha was given
[[nodiscard]] drawing::Figure alpha_figure(const AlphaSweep& sweep, std::optional<AlphaRule> used,
                                           std::string_view section);

}  // namespace tactile_net::pages

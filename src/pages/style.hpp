/// @file
/// Private. The one style sheet of all pages.
#pragma once

#include <string_view>

namespace tactile_net::pages {

/// CSS, for light and dark, from a telephone's width on, and for paper.
[[nodiscard]] std::string_view style_sheet() noexcept;

}  // namespace tactile_net::pages

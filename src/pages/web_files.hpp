/// @file
/// Private. The files of pages/web, compiled in: a page needs no other file and no network.
#pragma once

#include <string>
#include <string_view>

namespace tactile_net::pages {

/// The one style of all pages.
[[nodiscard]] std::string_view style_sheet() noexcept;

/// What draws a page's data, as elements for the end of its body: the plotting library with its
/// licence, and the scripts of pages/web.
[[nodiscard]] std::string drawing_scripts();

}  // namespace tactile_net::pages

/// @file
/// Private. The script of a recording's page: a slider moves one cursor through every picture.
#pragma once

#include <string_view>

namespace tactile_net::pages {

/// Text of a <script> that reads the element `data` (recording_json.hpp).
[[nodiscard]] std::string_view recording_script() noexcept;

}  // namespace tactile_net::pages

/// @file
/// Private. Places and sizes of drawings as text.
#pragma once

#include <string>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::pages {

/// In pixels, to a tenth.
[[nodiscard]] inline std::string px(double value) { return fixed(value, 1); }

}  // namespace tactile_net::pages

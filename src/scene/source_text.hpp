/// @file
/// Whether a scene's text is fit for a TOML parser.
#pragma once

#include <string_view>

#include "scene/problems.hpp"

namespace tactile_net {

/// Reports what toml++ 3.3 does not survive or explains badly: an empty file, bytes that are not
/// text, keys of so many parts that destroying the tables would overflow the stack.
void check_source_text(std::string_view text, Problems& problems);

}  // namespace tactile_net

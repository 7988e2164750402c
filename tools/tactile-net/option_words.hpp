/// @file
/// How the command spells what messages advise to ask for.
#pragma once

#include <string>

#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::tool {

/// "--columns 2-42"
[[nodiscard]] std::string spelled(Option option, std::string_view value);

}  // namespace tactile_net::tool

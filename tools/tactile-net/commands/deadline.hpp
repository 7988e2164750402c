/// @file
/// Times as a user writes them.
#pragma once

#include <string>

namespace tactile_net::tool {

/// "100us", "1 ms", "2e-5" [s], in every locale. @throw WrongUsage  it is no time > 0
[[nodiscard]] double deadline_of(const std::string& text);

}  // namespace tactile_net::tool

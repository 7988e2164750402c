/// @file
/// The manual page, from the texts of the help.
#pragma once

#include <string>

#include "command_line/table.hpp"

namespace tactile_net::tool {

/// In roff with the macros man(7), the same bytes whenever it is made.
[[nodiscard]] std::string man_page(const CommandLine& line);

}  // namespace tactile_net::tool

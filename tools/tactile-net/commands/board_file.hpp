/// @file
/// A board's file on the command line.
#pragma once

#include <optional>
#include <string>

#include "tactile_net/network/laid_board.hpp"

namespace tactile_net::tool {

/// @param path  empty: none is given
/// @throw InputError, std::invalid_argument  it cannot be read, or is none of KiCad's
[[nodiscard]] std::optional<LaidBoard> board_if(const std::string& path);

}  // namespace tactile_net::tool

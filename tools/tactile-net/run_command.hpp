/// @file
/// The command tactile-net as a function: what its program does, and what a test calls.
#pragma once

#include <span>
#include <string>

#include "streams.hpp"

namespace tactile_net::tool {

/// @param arguments  without the program's name
/// @return the exit status: 0 done, 1 a computation or a check failed, 2 wrong usage or bad input;
///         what went wrong is told on `streams.err`
[[nodiscard]] int run_command(std::span<const std::string> arguments, const Streams& streams);

}  // namespace tactile_net::tool

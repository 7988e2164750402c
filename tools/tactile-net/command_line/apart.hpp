/// @file
/// What a command writes stands apart from what it reads.
#pragma once

#include <span>
#include <string>

#include "command_line/table.hpp"

namespace tactile_net::tool {

/// What was typed for an argument.
struct Given {
  const Argument* argument = nullptr;
  std::string value{};
};

/// However two paths are spelled. Devices may be named twice.
///
/// @throw WrongUsage  a file that is to be written is one that is read, which would be lost, or is
///                    to be written twice; two documents would go to standard output
void require_apart(const CommandTable& command, std::span<const Given> given);

}  // namespace tactile_net::tool

/// @file
/// Arguments as they were typed, into the places that a table says.
#pragma once

#include <span>
#include <string>

#include "command_line/table.hpp"

namespace tactile_net::tool {

/// What was asked for.
struct Parsed {
  const CommandTable* command = nullptr;  ///< null: none was named
  bool help = false;
  bool release = false;
};

/// Sets the values of the arguments, then calls `chosen` of the command, unless help or the
/// release is asked for: the words behind that are not read. A value stands behind its option, or
/// glued to it: `-o FILE`, `-oFILE`, `--output FILE`, `--output=FILE`. Behind `--` there are no
/// options. A flag may be repeated.
///
/// @param arguments  without the program's name
/// @throw WrongUsage  a command or an option that there is not, with the one that was meant; too
///                    many arguments, or not enough; a value that is none, is missing, or is given
///                    twice; as `require_apart`
[[nodiscard]] Parsed parse(const CommandLine& line, std::span<const std::string> arguments);

}  // namespace tactile_net::tool

/// @file
/// The text of --help.
#pragma once

#include <string>

#include "command_line/table.hpp"
#include "terminal/text_style.hpp"

namespace tactile_net::tool {

/// @param command  null: of the program, with a line for each command
[[nodiscard]] std::string help_text(const CommandLine& line, const CommandTable* command,
                                    const TextStyle& style);

/// What a command or an argument is, as a sentence with its default.
[[nodiscard]] std::string sentence_of(const CommandTable& command);
[[nodiscard]] std::string sentence_of(const Argument& argument);

}  // namespace tactile_net::tool

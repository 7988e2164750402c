/// @file
/// Scripts by which shells complete the command line.
#pragma once

#include <string>

#include "command_line/table.hpp"

namespace tactile_net::tool {

enum class Shell { bash, zsh };
inline constexpr Shell shells[] = {Shell::bash, Shell::zsh};
[[nodiscard]] std::string name(Shell shell);

/// For bash: 3.2 and newer, without the package bash-completion. For zsh: a file "_tactile-net" on
/// its fpath, or read by `source` behind compinit. Both complete commands, options, the values that
/// can be told, and files by how their names end.
[[nodiscard]] std::string completion_script(const CommandLine& line, Shell shell);

}  // namespace tactile_net::tool

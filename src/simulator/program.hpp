/// @file
/// Which file a program's name means. Private.
#pragma once

#include <string>

namespace tactile_net {

/// The file that would be run, absolute; the name itself where there is none.
[[nodiscard]] std::string program_file(const std::string& name);

/// Whether the file is a script: its interpreter is another program, which starts others.
[[nodiscard]] bool is_script(const std::string& file);

}  // namespace tactile_net

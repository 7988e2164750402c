/// @file
/// A scene's text, from the disk, and whether it is fit for a TOML parser.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/problems.hpp"

namespace tactile_net {

/// The file's content.
///
/// @throw InputError  not a readable regular file, or larger than 16 MiB
[[nodiscard]] std::string source_text(const std::filesystem::path& path);

/// Reports what toml++ 3.3 does not survive or explains badly: an empty file, bytes that are not
/// text, keys of so many parts that destroying the tables would overflow the stack.
void check_source_text(std::string_view text, Problems& problems);

}  // namespace tactile_net

/// @file
/// A whole file in memory, whoever wrote it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tactile_net {

/// The file's content.
///
/// @param largest  [bytes]
/// @param hint     for who has named a file that is larger
/// @throw InputError  no readable regular file (a device never ends, a pipe may never begin), or
///                    larger
[[nodiscard]] std::string bounded_text(const std::filesystem::path& path, std::uintmax_t largest,
                                       const std::string& hint);

}  // namespace tactile_net

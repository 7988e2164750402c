/// @file
/// A whole file in memory, whoever wrote it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
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

/// The same of a stream, to its end. @param name  in messages
[[nodiscard]] std::string bounded_text(std::istream& in, const std::string& name,
                                       std::uintmax_t largest, const std::string& hint);

/// The text of a scene or a hand, which has some hundred bytes.
///
/// @throw InputError  not a readable regular file, or larger than 16 MiB
[[nodiscard]] std::string input_text(const std::filesystem::path& path);
[[nodiscard]] std::string input_text(std::istream& in, const std::string& name);

}  // namespace tactile_net

/// @file
/// Pieces of text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

/// The parts with the separator between them.
[[nodiscard]] std::string join(const std::vector<std::string>& parts, std::string_view separator);

/// The parts between separators, one at least: "a,,b" has three.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// In single quotes, as every POSIX shell reads it.
[[nodiscard]] std::string shell_quoted(std::string_view text);

/// As one types it: quoted only where a shell would read it otherwise.
[[nodiscard]] std::string shell_word(std::string_view text);

/// As a field of CSV: in quotes, its own doubled (RFC 4180).
[[nodiscard]] std::string csv_quoted(std::string_view text);

}  // namespace tactile_net

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

/// The text in single quotes, as every POSIX shell reads it.
[[nodiscard]] std::string shell_quoted(std::string_view text);

/// The text as one types it in a shell: quoted only where the shell would read it otherwise.
[[nodiscard]] std::string shell_word(std::string_view text);

/// The text as a field of CSV: in quotes, with quotes inside it doubled (RFC 4180).
[[nodiscard]] std::string csv_quoted(std::string_view text);

}  // namespace tactile_net

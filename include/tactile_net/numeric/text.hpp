/// @file
/// Pieces of text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

/// The parts with the separator between them.
[[nodiscard]] std::string join(const std::vector<std::string>& parts, std::string_view separator);

/// As a field of CSV: in quotes, its own doubled (RFC 4180).
[[nodiscard]] std::string csv_quoted(std::string_view text);

}  // namespace tactile_net

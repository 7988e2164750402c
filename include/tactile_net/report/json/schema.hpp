/// @file
/// The JSON Schema (draft 2020-12) of every document that is written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::report {

/// The kinds that there are, by their names: "run", "check". In the order of the alphabet.
[[nodiscard]] std::vector<std::string_view> schema_kinds();

/// The schema of a kind, complete in itself.
///
/// @throw std::invalid_argument  there is no such kind
[[nodiscard]] std::string schema(std::string_view kind);

/// What documents of a kind are, in a line.
///
/// @throw std::invalid_argument  there is no such kind
[[nodiscard]] std::string schema_title(std::string_view kind);

}  // namespace tactile_net::report

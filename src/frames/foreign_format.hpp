/// @file
/// Files that hold frames in a way that is not read here, by how they begin. Private.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tactile_net::frames {

struct ForeignFormat {
  std::string what{};        ///< "is a zip archive"
  std::string what_to_do{};  ///< the way out
};

/// @param start  the first bytes of the file, a line or more of them
[[nodiscard]] std::optional<ForeignFormat> foreign_format(std::string_view start);

}  // namespace tactile_net::frames

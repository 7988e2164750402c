/// @file
/// Which files a file may name that came from somewhere else. Private.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "scene/value.hpp"

namespace tactile_net {

struct References {
  std::filesystem::path folder{};  ///< of the file that refers
  bool allow_outside = false;

  /// Beside the file that refers or below it, links followed; or all is allowed.
  [[nodiscard]] bool allow(const std::filesystem::path& path) const;
};

/// The file that a scene names; a problem where it lies elsewhere than the scene.
///
/// @param folder   of the scene's file
/// @param example  of the key
[[nodiscard]] std::optional<std::filesystem::path> path_beside(const Value& value,
                                                               const std::filesystem::path& folder,
                                                               std::string_view example);

}  // namespace tactile_net

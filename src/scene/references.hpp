/// @file
/// Which files a file may name that came from somewhere else. Private.
#pragma once

#include <filesystem>

namespace tactile_net {

struct References {
  std::filesystem::path folder{};  ///< of the file that refers
  bool allow_outside = false;

  /// Beside the file that refers or below it, links followed; or all is allowed.
  [[nodiscard]] bool allow(const std::filesystem::path& path) const;
};

}  // namespace tactile_net

/// @file
/// One run at a time writes into a folder of results.
#pragma once

#include <filesystem>

#include "tactile_net/frames/cannot_create.hpp"
#include "tactile_net/system/file_lock.hpp"

namespace tactile_net::frames {

/// Held as long as this lives; a process that is killed loses it at once. The lock is a file beside
/// the folder, `.NAME.lock`, or in it where nothing can be made beside it.
class FolderLock {
 public:
  /// @param folder  need not be there yet
  /// @throw CannotCreate  another run writes there: names the folder and its process
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  RunLock lock_;
};

}  // namespace tactile_net::frames

#include "tactile_net/frames/folder_lock.hpp"

#include <unistd.h>

#include <string>
#include <system_error>

namespace tactile_net::frames {
namespace {

namespace fs = std::filesystem;

/// The same for every name of the folder.
fs::path lock_file(const fs::path& folder) {
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(folder, error), error);
  if (error) place = folder;
  if (!place.has_filename()) place = place.parent_path();
  const fs::path parent = place.has_parent_path() ? place.parent_path() : ".";
  if (::access(parent.c_str(), W_OK) != 0 && fs::is_directory(place, error))
    return place / ".tactile-net.lock";
  return parent / ("." + place.filename().string() + ".lock");
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  const auto owner = lock_.take(lock_file(folder));
  if (!owner) return;
  const std::string who =
      (owner->process == 0 ? "another process" : "process " + std::to_string(owner->process)) +
      (owner->host.empty() ? "" : " on " + owner->host);
  throw CannotCreate(
      folder.string() + ": error: " + who +
      " is writing results into this folder: wait until it ends, or name another folder");
}

}  // namespace tactile_net::frames

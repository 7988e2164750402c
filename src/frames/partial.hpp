/// @file
/// The temporary name of an output that is not whole yet. Private.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tactile_net/system/file_lock.hpp"
#include "tactile_net/system/leftovers.hpp"

namespace tactile_net::frames {

/// A file or a folder under the name `NAME.partial-NUMBER`, which nobody else has: the number is
/// random, since processes of two containers may have one number and one folder. Removed at the
/// end, a sudden one too. What a process that was killed has left under such a name is removed by
/// who writes there next.
class Partial {
 public:
  Partial() noexcept = default;
  ~Partial() { remove(); }
  Partial(const Partial&) = delete;
  Partial& operator=(const Partial&) = delete;

  // Each removes left-overs of that output first. False: nothing is made, and errno says why.
  /// @param permissions  at most, as far as the process' own mask lets them be
  [[nodiscard]] bool make_file_beside(const std::filesystem::path& path,
                                      std::filesystem::perms permissions);
  [[nodiscard]] bool make_folder_beside(const std::filesystem::path& path);
  /// Nobody else may look into it.
  [[nodiscard]] bool make_folder_in(const std::filesystem::path& folder);
  /// It has been moved to where it belongs.
  void moved() noexcept;

  [[nodiscard]] bool there() const noexcept { return !path_.empty(); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  /// Makes what is not there. False: it did not, and errno says why.
  using Maker = std::function<bool(const std::filesystem::path& name)>;
  bool make(const std::filesystem::path& folder, const std::string& prefix, const Maker& maker);
  void remove() noexcept;

  std::filesystem::path path_;
  Leftover leftover_;
  FileLock lock_;
};

}  // namespace tactile_net::frames

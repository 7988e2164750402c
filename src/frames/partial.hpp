/// @file
/// The temporary name of an output that is not whole yet. Private.
#pragma once

#include <filesystem>
#include <string>

#include "tactile_net/system/file_lock.hpp"
#include "tactile_net/system/leftovers.hpp"

namespace tactile_net::frames {

/// A file or a folder under the name `NAME.partial-PID`: removed at the end, a sudden one too. What
/// a process that was killed has left under such a name is removed by who writes there next.
class Partial {
 public:
  Partial() noexcept = default;
  ~Partial() { remove(); }
  Partial(const Partial&) = delete;
  Partial& operator=(const Partial&) = delete;

  /// The temporary name beside `path`, for its maker to make; left-overs of that output go.
  [[nodiscard]] static std::filesystem::path name_beside(const std::filesystem::path& path);
  /// The same inside a folder.
  [[nodiscard]] static std::filesystem::path name_in(const std::filesystem::path& folder);

  /// Its maker makes it next: what a signal in between finds goes too.
  void will_be(const std::filesystem::path& path);
  /// It is there, and this process works on it.
  void made();
  /// It has been moved to where it belongs.
  void moved() noexcept;

  [[nodiscard]] bool there() const noexcept { return !path_.empty(); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void remove() noexcept;

  std::filesystem::path path_;
  Leftover leftover_;
  FileLock lock_;
};

}  // namespace tactile_net::frames

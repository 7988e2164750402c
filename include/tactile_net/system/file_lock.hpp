/// @file
/// Locks that the kernel takes away with their process, however that ends.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "tactile_net/system/leftovers.hpp"

namespace tactile_net {

/// The lock on an open file or folder (flock).
class FileLock {
 public:
  FileLock() noexcept = default;
  ~FileLock() { reset(); }
  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  /// Locks a file or a folder that is there, links not followed; nothing if it cannot be opened, or
  /// another process holds the lock.
  [[nodiscard]] static std::optional<FileLock> of(const std::filesystem::path& path) noexcept;

  void reset() noexcept;

 private:
  friend class RunLock;
  explicit FileLock(int descriptor) noexcept : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Who holds a lock.
struct LockOwner {
  pid_t process = 0;   ///< 0: it did not write its number
  std::string host{};  ///< of its machine; empty: this one

  bool operator==(const LockOwner&) const = default;
};

/// A lock file, which holds the process and the machine of who made it, and goes with it. A file
/// that a killed process left behind is nobody's, and is taken over.
class RunLock {
 public:
  RunLock() noexcept = default;
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Takes the lock, or says who has it.
  ///
  /// Where no lock file can be made, nothing is held and nobody is named: the file system has no
  /// locks, or the folder is not ours to write, and who writes there will say so.
  std::optional<LockOwner> take(const std::filesystem::path& file);

 private:
  FileLock lock_;
  std::filesystem::path file_;
  Leftover leftover_;
};

}  // namespace tactile_net

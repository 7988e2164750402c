/// @file
/// What must not outlive this process: files under temporary names, private folders, children.
///
/// Destructors remove them where the stack unwinds. A signal unwinds nothing: so each is also
/// entered in a table of fixed size, which a signal handler can walk. A process that is killed
/// outright removes nothing; what it leaves is found by its lock, which went with it (see
/// file_lock.hpp), and by the next run.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace tactile_net {

/// A file or a folder that goes at a sudden end, as long as this lives. Where the table is full, or
/// the path is longer than the system takes, it is not entered.
class Leftover {
 public:
  Leftover() noexcept = default;
  /// @param path  made absolute
  explicit Leftover(const std::filesystem::path& path);
  ~Leftover() { release(); }
  Leftover(Leftover&& other) noexcept;
  Leftover& operator=(Leftover&& other) noexcept;

  /// It is no left-over any more. Touches no file.
  void release() noexcept;

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t slot_ = none;
};

/// A child, leader of a process group, that is killed with its group at a sudden end, as long as
/// this lives.
class LeftoverChild {
 public:
  explicit LeftoverChild(pid_t leader) noexcept;
  ~LeftoverChild();
  LeftoverChild(const LeftoverChild&) = delete;
  LeftoverChild& operator=(const LeftoverChild&) = delete;

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t slot_ = none;
};

/// Kills and removes all that is entered. For a signal handler whose process ends thereafter: calls
/// only what is safe there. In a forked child it does nothing: what is entered is its parent's.
void remove_leftovers() noexcept;

}  // namespace tactile_net

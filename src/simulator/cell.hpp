/// @file
/// Puts the calling process into confinement, for good. Private.
#pragma once

namespace tactile_net {

/// The one program that a confined process may become: the arguments of its `execve`, as pointers.
/// After it, no pointer of the new program is theirs but by chance, and no deck chooses pointers.
struct OnlyProgram {
  const char* path = nullptr;
  char* const* arguments = nullptr;
};

struct Cell {
  const char* folder = nullptr;  ///< what may be written in; null: nothing
  bool starts_nothing = true;    ///< no other process but threads, no socket, no signal
  OnlyProgram only{};            ///< if it starts nothing: what it may become; none: nothing
  /// If given, gets a descriptor for `serve_temporary_file`, or -1 where the kernel has none.
  ///
  /// The C library's `tmpfile`, which ngspice calls at its start, asks for a file without a name in
  /// /tmp, wherever TMPDIR is. To allow that is to allow writing to every file there. So another
  /// process is asked for such a file, who is not confined.
  int* listener = nullptr;
};

/// From here on the process, and what it starts, writes in its folder and to /dev/null alone. Does
/// nothing of what the kernel, or this machine's architecture, has no means for. Safe after fork.
///
/// @return 0, or errno of what failed: the process is then not to go on
[[nodiscard]] int confine(const Cell& cell) noexcept;

/// Answers the next of a confined process' calls for a file without a name, with one in memory. To
/// be called when `listener` is readable.
void serve_temporary_file(int listener) noexcept;

}  // namespace tactile_net

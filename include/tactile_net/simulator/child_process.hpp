/// @file
/// Runs another program with limits on its time and its output (Linux).
///
/// The program never outlives its caller: however the caller ends, the kernel kills it, and what a
/// signal handler removes at a sudden end includes it (`system/leftovers.hpp`).
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tactile_net {

struct ProcessOptions {
  std::filesystem::path folder{};       ///< working directory; empty: the caller's
  std::string input{};                  ///< written to its standard input
  std::vector<std::string> unset{};     ///< environment variables to hide from it
  std::vector<std::string> defaults{};  ///< "NAME=value": given to it where the caller has no NAME
  /// Wall time; then it and its children are killed. Its processors' time is limited by this too,
  /// times their number.
  std::chrono::milliseconds time_limit{60'000};
  std::size_t output_limit = 16U << 20;           ///< bytes kept; more kills it
  std::size_t file_limit = std::size_t{1} << 30;  ///< largest file it may write [bytes]
  /// It writes in `folder` alone (empty: nowhere) and starts nothing, as far as the kernel has the
  /// means: see `confinement`. Of a script only the files are confined.
  bool confined = false;
  /// Asked about every 50 ms; true: it and its children are killed. Null: nobody is asked.
  bool (*cancelled)() = nullptr;
};

struct ProcessResult {
  enum class End { exited, signalled, timed_out, cancelled, too_much_output, not_found };
  End end = End::exited;
  int code = 0;          ///< exit status, or the number of the signal
  std::string output{};  ///< standard output
  std::string errors{};  ///< standard error
  double seconds = 0.0;  ///< wall time
};

/// Runs `command` (program, arguments; the program is looked up in PATH) and waits for its end. The
/// caller may ignore SIGCHLD, or have a handler that collects all children.
///
/// @throw std::system_error   the system gave no pipe or process
/// @throw std::runtime_error  SIGCHLD is as the system sets it, and yet a thread of the caller has
///                            collected the program's end
[[nodiscard]] ProcessResult run_process(const std::vector<std::string>& command,
                                        const ProcessOptions& options = {});

}  // namespace tactile_net

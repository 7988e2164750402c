/// @file
/// Ctrl-C, the end of the terminal, a service manager's SIGTERM: the command ends, and leaves
/// nothing behind.
#pragma once

#include <array>
#include <csignal>

namespace tactile_net::tool {

/// While one lives, SIGINT, SIGTERM and SIGHUP kill what the command has started, remove what it
/// has half written (`system/leftovers.hpp`), and end the process as ever, by the signal: who
/// called it sees which. A signal that is ignored, as under nohup, stays ignored.
///
/// Every command has one: no computation has to ask for it.
class Interruption {
 public:
  Interruption() noexcept;
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

 private:
  std::array<struct sigaction, 3> before_{};
};

/// While one lives inside an `Interruption`, the first signal is a wish to stop, which long work
/// that can be resumed asks for between its steps; the second ends the process as above.
class InterruptionAsWish {
 public:
  InterruptionAsWish() noexcept;
  ~InterruptionAsWish();
  InterruptionAsWish(const InterruptionAsWish&) = delete;
  InterruptionAsWish& operator=(const InterruptionAsWish&) = delete;

  [[nodiscard]] static bool came() noexcept;
};

}  // namespace tactile_net::tool

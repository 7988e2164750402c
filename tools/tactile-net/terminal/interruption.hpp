/// @file
/// Ctrl-C as a wish to stop, not as an end: long work asks for it between its steps.
#pragma once

#include <csignal>

namespace tactile_net::tool {

/// While one lives, SIGINT and SIGTERM are remembered; a second one ends the program as usual.
class Interruption {
 public:
  Interruption() {
    came_ = 0;
    struct sigaction action {};
    action.sa_handler = [](int) { came_ = 1; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(SIGINT, &action, &interrupt_);
    ::sigaction(SIGTERM, &action, &terminate_);
  }
  ~Interruption() {
    ::sigaction(SIGINT, &interrupt_, nullptr);
    ::sigaction(SIGTERM, &terminate_, nullptr);
  }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  [[nodiscard]] static bool came() noexcept { return came_ != 0; }

 private:
  static inline volatile std::sig_atomic_t came_ = 0;
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

}  // namespace tactile_net::tool

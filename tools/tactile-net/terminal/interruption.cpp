#include "terminal/interruption.hpp"

#include "tactile_net/system/leftovers.hpp"

namespace tactile_net::tool {
namespace {

constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t wish = 0;         // the next signal is only one
volatile std::sig_atomic_t interrupted = 0;  // it came

void on_signal(int number) {
  if (wish != 0) {
    wish = 0;
    interrupted = 1;
    return;
  }
  remove_leftovers();
  ::signal(number, SIG_DFL);
  ::raise(number);  // comes as soon as this handler returns, which blocks it
}

}  // namespace

Interruption::Interruption() noexcept {
  wish = 0;
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : signals) ::sigaddset(&action.sa_mask, number);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    ::sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) ::sigaction(signals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
}

InterruptionAsWish::InterruptionAsWish() noexcept {
  interrupted = 0;
  wish = 1;
}

InterruptionAsWish::~InterruptionAsWish() { wish = 0; }

bool InterruptionAsWish::came() noexcept { return interrupted != 0; }

}  // namespace tactile_net::tool

#include "terminal/progress.hpp"

#include <ostream>

#include "tactile_net/report/words/step_words.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {
constexpr std::string_view clear_line = "\r\033[K";
}

void Progress::clear() {
  if (shown_) err_ << clear_line << std::flush;
  shown_ = false;
}

void Progress::step(const lab::Step& step) {
  if (step.kind != lab::Step::Kind::frame || due()) say(report::in_words(step));
}

void Progress::say(const std::string& text) {
  if (!terminal_) return;
  err_ << clear_line << printable(text) << std::flush;
  shown_ = true;
}

void Progress::frames(std::size_t done, std::optional<double> share) {
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start_;
  say(report::frames_in_words(done, share, gone.count()));
}

bool Progress::due() noexcept {
  if (!terminal_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(200)) return false;
  last_ = now;
  return true;
}

}  // namespace tactile_net::tool

#include "watcher.hpp"

#include <nanobind/stl/string.h>

#include "tactile_net/report/words/step_words.hpp"

namespace tactile_net::python {

bool Watcher::due() noexcept {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(50)) return false;
  last_ = now;
  return true;
}

void Watcher::step(const lab::Step& step) {
  if (step.kind == lab::Step::Kind::frame && !due()) return;
  const nb::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  if (!progress_.is_none()) progress_(report::in_words(step));
}

}  // namespace tactile_net::python

/// @file
/// Long work heard in Python: Ctrl-C ends it, and whoever wants to is told what begins.
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <utility>

#include "tactile_net/lab/observer.hpp"

namespace tactile_net::python {

namespace nb = nanobind;

/// For work without the GIL, which it takes for a moment at each step; at the frames of a
/// recording, which come thousands a second, every 50 ms.
class Watcher final : public lab::Observer {
 public:
  /// @param progress  called with a sentence at each step; None: nobody is told
  explicit Watcher(nb::object progress = nb::none()) : progress_(std::move(progress)) {}

  /// @throw nb::python_error  a signal's handler or `progress` has raised
  void step(const lab::Step& step) override;

  /// The same between frames that nobody is told of.
  void frame() { step({.kind = lab::Step::Kind::frame}); }

 private:
  [[nodiscard]] bool due() noexcept;

  nb::object progress_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace tactile_net::python

/// @file
/// One line on a terminal that says what is going on; nothing when nobody watches.
#pragma once

#include <chrono>
#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

#include "streams.hpp"
#include "tactile_net/lab/observer.hpp"

namespace tactile_net::tool {

class Progress final : public lab::Observer {
 public:
  explicit Progress(const Streams& streams)
      : err_(streams.screen != nullptr ? *streams.screen : streams.err),
        terminal_(streams.terminal) {}
  ~Progress() override { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows a step at once; frames about five times a second.
  void step(const lab::Step& step) override;
  void say(const std::string& text);

  /// Removes the line.
  void clear();

  /// "5203 frames, 12 %, about 40 s left": how far a recording has come.
  ///
  /// @param share  of it, 0 to 1; nothing where its length is not known
  void frames(std::size_t done, std::optional<double> share);

  /// True about five times a second on a terminal: time to build a text and call `say`.
  [[nodiscard]] bool due() noexcept;

 private:
  std::ostream& err_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace tactile_net::tool

/// @file
/// The times of a recording: their units, and what they are in seconds.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "tactile_net/scene/units.hpp"

namespace tactile_net::frames {

/// From ns to h, in any usual spelling. @return  to seconds
[[nodiscard]] inline std::optional<Unit> time_unit_named(std::string_view text) noexcept {
  struct Row {
    std::string_view text;
    Unit unit;
  };
  constexpr Unit ns{"ns", 1.0, 1e9}, us{"us", 1.0, 1e6}, ms{"ms", 1.0, 1e3}, s{"s"},
      min{"min", 60.0}, h{"h", 3600.0};
  constexpr std::array<Row, 25> rows = {{
      {"s", s},          {"sec", s},           {"secs", s},         {"second", s},
      {"seconds", s},    {"ms", ms},           {"msec", ms},        {"millis", ms},
      {"millisec", ms},  {"milliseconds", ms}, {"us", us},          {"usec", us},
      {"\xc2\xb5s", us}, {"\xce\xbcs", us},    {"micros", us},      {"microseconds", us},
      {"ns", ns},        {"nsec", ns},         {"nsecs", ns},       {"nanos", ns},
      {"nanosec", ns},   {"nanosecs", ns},     {"nanoseconds", ns}, {"min", min},
      {"h", h},
  }};
  for (const Row& row : rows)
    if (row.text == text) return row.unit;
  return std::nullopt;
}

/// The unit that a time since 1970 can only be in: 1.7e9 s, 1.7e12 ms, 1.7e15 us, 1.7e18 ns; of
/// seconds smaller numbers, a counter's, look the same. @return  nothing: the number does not say
[[nodiscard]] inline std::optional<Unit> time_unit_by_size(double time) noexcept {
  if (time >= 1e11 && time < 1e14) return time_unit_named("ms");
  if (time >= 1e14 && time < 1e17) return time_unit_named("us");
  if (time >= 1e17 && time < 1e20) return time_unit_named("ns");
  return std::nullopt;
}

/// The clock of a recording: what its times are in seconds.
class FrameClock {
 public:
  FrameClock() = default;
  /// @param stated  by the name of the column; nothing: the numbers show it, if anything does
  explicit FrameClock(const std::optional<Unit>& stated) noexcept : unit_(stated) {}

  /// The next frame's time. @pre  finite
  void add(double time) noexcept {
    if (!unit_ && !last_) unit_ = time_unit_by_size(time);
    has_decimals_ = has_decimals_ || time != std::floor(time);
    last_ = time;
    now_ = time;
  }
  /// The next frame has none.
  void skip() noexcept { now_.reset(); }

  /// The last number that there was.
  [[nodiscard]] const std::optional<double>& last() const noexcept { return last_; }
  /// Of the frame last read, as `FrameSource`.
  [[nodiscard]] std::optional<double> seconds() const noexcept {
    return now_ && unit_ ? unit_->to_si(*now_) : now_;
  }
  /// Seconds have decimals; whole numbers without a stated unit may be anything.
  [[nodiscard]] bool unit_known() const noexcept { return unit_ || has_decimals_ || !last_; }

 private:
  std::optional<Unit> unit_{};
  std::optional<double> last_{};
  std::optional<double> now_{};
  bool has_decimals_ = false;
};

}  // namespace tactile_net::frames

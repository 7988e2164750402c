/// @file
/// Where frames come from and where they go, whatever the file's format.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/sensing/array.hpp"

namespace tactile_net::frames {

/// "strain_x_0" ... for every channel of an array, in the order of its readings.
[[nodiscard]] std::vector<std::string> reading_columns(const SensorArray& array);

/// The columns of a tractions file: "normal_0" ..., then "tangential_0" ...
[[nodiscard]] std::vector<std::string> traction_columns(std::size_t count, bool with_tangential);

/// Recorded frames, one after another in constant memory.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, false at the end of the input.
  ///
  /// @param values  one per column; 0 where unread
  /// @throw InputError  the frame is not whole, or a value not a finite number
  [[nodiscard]] virtual bool next(std::span<double> values) = 0;

  /// @throw InputError  always: what is wrong with the frame last read
  [[noreturn]] virtual void refuse(const std::string& message, const std::string& hint) const = 0;

  /// The names of what `next` returns, in its order.
  [[nodiscard]] virtual std::span<const std::string> columns() const noexcept = 0;

  [[nodiscard]] virtual bool has_time() const noexcept { return false; }
  /// The text of column `t` in the frame last read.
  [[nodiscard]] virtual std::string_view time() const noexcept { return {}; }
  /// Columns of the file that are not read.
  [[nodiscard]] virtual std::span<const std::string> ignored() const noexcept { return {}; }
};

/// Frames on their way to a file.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// @param time    text of the column `t`; not used without one
  /// @param values  one per column; NaN is an empty field in CSV
  virtual void add(std::string_view time, std::span<const double> values) = 0;
  /// Hands on everything so far. @throw std::runtime_error  it could not be written
  virtual void flush() = 0;
  /// To be called once, after the last frame.
  virtual void finish() { flush(); }
};

}  // namespace tactile_net::frames

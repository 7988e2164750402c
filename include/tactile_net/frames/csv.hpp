/// @file
/// Frames on disk: where they come from, where they go, and as CSV, a header and one frame a row.
#pragma once

#include <cstddef>
#include <iosfwd>
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
  /// @param readings  one value per column; 0 where unread
  /// @throw InputError  the frame is not whole, or a value not a finite number
  [[nodiscard]] virtual bool next(std::span<double> readings) = 0;

  /// @throw InputError  always: what is wrong with the frame last read
  [[noreturn]] virtual void refuse(const std::string& message, const std::string& hint) const = 0;

  [[nodiscard]] virtual bool has_time() const noexcept { return false; }
  /// The text of column `t` in the frame last read.
  [[nodiscard]] virtual std::string_view time() const noexcept { return {}; }
  /// Columns of the file that are not read.
  [[nodiscard]] virtual std::span<const std::string> ignored() const noexcept { return {}; }
};

/// CSV; columns are found by name.
class CsvFrames final : public FrameSource {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  // bytes

  /// Reads the header.
  ///
  /// @param columns   names of the readings, in the order `next` returns them
  /// @param unread    per column: true if its values do not matter (a dead taxel) and may be any
  /// text
  /// @param file      name for messages
  /// @throw InputError  there is no header, a column is missing or stands twice
  CsvFrames(std::istream& in, std::string file, std::span<const std::string> columns,
            std::vector<bool> unread);

  /// As `FrameSource`; rows that are empty are skipped. @throw InputError  a row has too few or too
  /// many fields too: the text names file, line and column
  [[nodiscard]] bool next(std::span<double> readings) override;
  [[noreturn]] void refuse(const std::string& message, const std::string& hint) const override;

  [[nodiscard]] bool has_time() const noexcept override { return has_time_; }
  [[nodiscard]] std::string_view time() const noexcept override { return time_; }
  [[nodiscard]] std::span<const std::string> ignored() const noexcept override { return ignored_; }

 private:
  [[nodiscard]] bool read_line();
  [[noreturn]] void fail(std::string_view field, const std::string& message,
                         const std::string& hint = {}) const;

  std::istream& in_;
  std::string file_;
  std::vector<std::string> header_;
  std::vector<std::ptrdiff_t> target_;  // per field of a row: index into readings, or below
  std::vector<bool> unread_;
  std::vector<std::string> ignored_;
  std::vector<char> buffer_;
  std::string_view row_;
  std::string_view time_;
  std::size_t line_ = 0;
  bool has_time_ = false;
};

/// Frames on their way to a file.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// @param time  text of the column `t`; not used without one
  virtual void add(std::string_view time, std::span<const double> values) = 0;
  /// Hands on everything so far. @throw std::runtime_error  it could not be written
  virtual void flush() = 0;
  /// To be called once, after the last frame.
  virtual void finish() { flush(); }
};

/// CSV: a header, `t` first if `with_time`, then one frame a row. Written when a block is full.
class CsvSink final : public FrameSink {
 public:
  CsvSink(std::ostream& out, std::span<const std::string> columns, bool with_time);
  void add(std::string_view time, std::span<const double> values) override;
  void flush() override;

 private:
  std::ostream& out_;
  bool with_time_;
  std::string text_;
};

/// The names, and `t` first if `with_time`, separated by commas, and a newline.
void append_header(std::string& out, std::span<const std::string> columns, bool with_time);

/// Values separated by commas, shortest exact text, and a newline.
void append_row(std::string& out, std::span<const double> values);

}  // namespace tactile_net::frames

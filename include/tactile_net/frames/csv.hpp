/// @file
/// Frames as CSV: a header, then one frame a row. Numbers are the same in every locale.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

/// Reads CSV; columns are found by name.
class CsvFrames final : public FrameSource {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  // bytes

  /// Which columns to read, given the names in the file's header.
  using ChooseColumns =
      std::function<std::vector<std::string>(std::span<const std::string> header)>;

  /// Reads the header.
  ///
  /// @param file     name for messages
  /// @param columns  names to read, in the order `next` returns them
  /// @param unread   per column: true if its values do not matter (a dead taxel) and may be any
  ///                 text; empty: all matter
  /// @throw InputError  there is no header, a column is missing or stands twice
  CsvFrames(std::istream& in, std::string file, std::vector<std::string> columns,
            std::vector<bool> unread = {});

  /// The same where the columns depend on what the file has.
  CsvFrames(std::istream& in, std::string file, const ChooseColumns& choose);

  /// As `FrameSource`; rows that are empty are skipped. @throw InputError  a row has too few or too
  /// many fields too: the text names file, line and column
  [[nodiscard]] bool next(std::span<double> values) override;
  [[noreturn]] void refuse(const std::string& message, const std::string& hint) const override;

  [[nodiscard]] std::span<const std::string> columns() const noexcept override { return columns_; }
  [[nodiscard]] bool has_time() const noexcept override { return has_time_; }
  [[nodiscard]] std::string_view time() const noexcept override { return time_; }
  [[nodiscard]] std::span<const std::string> ignored() const noexcept override { return ignored_; }

 private:
  CsvFrames(std::istream& in, std::string file);
  void read_header();
  void find(std::vector<std::string> columns);
  [[nodiscard]] bool read_line();
  [[noreturn]] void fail(std::string_view field, const std::string& message,
                         const std::string& hint = {}) const;

  std::istream& in_;
  std::string file_;
  std::vector<std::string> header_;
  std::vector<std::string> columns_;
  std::vector<std::ptrdiff_t> target_;  // per field of a row: index into the values, or below
  std::vector<bool> unread_;
  std::vector<std::string> ignored_;
  std::vector<char> buffer_;
  std::string_view row_;
  std::string_view time_;
  std::size_t line_ = 0;
  bool has_time_ = false;
};

/// Writes CSV, `t` first if `with_time`; a block at a time.
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

/// Values separated by commas, shortest exact text, NaN as an empty field, and a newline.
void append_row(std::string& out, std::span<const double> values);

}  // namespace tactile_net::frames

/// @file
/// Recorded frames as CSV: a header, then one frame a row.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/sensing/array.hpp"

namespace tactile_net::tool {

/// "strain_x_0" ... for every channel of an array, in the order of its readings.
[[nodiscard]] std::vector<std::string> reading_columns(const SensorArray& array);

/// @throw InputError  a folder, or it cannot be opened
[[nodiscard]] std::ifstream open_csv(const std::filesystem::path& path);

/// Reads frames row by row in constant memory; columns are found by name.
class FrameReader {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  // bytes

  /// Reads the header.
  ///
  /// @param columns   names of the readings, in the order `next` returns them
  /// @param unread    per column: true if its values do not matter (a dead taxel) and may be any
  /// text
  /// @param file      name for messages
  /// @throw InputError  there is no header, a column is missing or stands twice
  FrameReader(std::istream& in, std::string file, std::span<const std::string> columns,
              std::vector<bool> unread);

  /// The next frame, false at the end of the input. Rows that are empty are skipped.
  ///
  /// @param readings  one value per column; 0 where unread
  /// @throw InputError  the row has too few or too many fields, or one is not a finite number: the
  ///                    text names file, line and column
  [[nodiscard]] bool next(std::span<double> readings);

  [[nodiscard]] bool has_time() const noexcept { return has_time_; }
  /// The text of column `t` in the frame last read.
  [[nodiscard]] std::string_view time() const noexcept { return time_; }
  /// Columns of the file that are not read.
  [[nodiscard]] const std::vector<std::string>& ignored() const noexcept { return ignored_; }
  /// Line of the frame last read, from 1.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

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

/// Header of a tractions file: t if `with_time`, then normal_0 ..., then tangential_0 ...
void append_traction_header(std::string& out, std::size_t count, bool with_tangential,
                            bool with_time);

/// Values separated by commas, shortest exact text, and a newline.
void append_row(std::string& out, std::span<const double> values);

}  // namespace tactile_net::tool

/// @file
/// What comes before the first frame of a text file: comments, the line with the names. Private.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frames/csv_layout.hpp"
#include "frames/text_lines.hpp"

namespace tactile_net::frames {

struct CsvHeader {
  CsvLayout layout{};                ///< of the rows
  std::vector<std::string> names{};  ///< none: the file has none
  std::string text{};                ///< the line that holds them, as in the file
  std::vector<std::size_t> at{};     ///< per name: the byte of `text` at which it begins
  /// The line that was read last is a row: there are no names, or they were a comment.
  bool row_pending = false;
  std::size_t row_fields = 0;  ///< of that row
};

/// Reads up to the names, or to the first row: the next lines are rows.
///
/// @param got  what the last call of `lines.next()` said: without a line there is no header
[[nodiscard]] std::optional<CsvHeader> read_header(TextLines& lines, TextLines::Got& got);

}  // namespace tactile_net::frames

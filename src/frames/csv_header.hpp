/// @file
/// What comes before the first frame of a text file: comments, words of a logger, the line with the
/// names, lines with units and remarks. Private.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frames/text_lines.hpp"
#include "numeric/csv_fields.hpp"

namespace tactile_net::frames {

struct HeldLine {
  std::size_t number = 0;  ///< from 1
  std::string text{};
};

struct CsvHeader {
  CsvLayout layout{};                ///< of the rows
  std::vector<std::string> names{};  ///< none: the file has none
  HeldLine line{};                   ///< that holds them, as in the file
  std::vector<std::size_t> at{};     ///< per name: the byte of that line at which it begins
  std::deque<HeldLine> rows{};       ///< that had to be read to find the names: the first rows
  std::size_t row_fields = 0;        ///< of the first of them
  std::vector<std::string> notes{};  ///< which lines were read as something else than frames
};

/// Reads up to the first row. A line with a unit for each column (s,kPa,kPa) puts it behind the
/// names, as "stress_x_0 [kPa]"; numbers below names that stand over groups of columns become part
/// of them, as "stress_x_0".
///
/// @param got  what the last call of `lines.next()` said: without a line there is no header, or
///             one without rows
[[nodiscard]] std::optional<CsvHeader> read_header(TextLines& lines, TextLines::Got& got);

}  // namespace tactile_net::frames

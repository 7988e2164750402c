/// @file
/// Source text made fit for a terminal. Columns count code points, from 1; a byte that is not
/// UTF-8 counts as one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tactile_net {

/// Part of a line, and the column at which it begins.
struct Excerpt {
  std::string text;
  std::size_t column = 1;
};

/// Bytes of the code point that begins `text`, 1 to 4; 0: not UTF-8. `text` must not be empty.
[[nodiscard]] std::size_t code_point_size(std::string_view text) noexcept;

/// Code points in `text`.
[[nodiscard]] std::size_t code_points(std::string_view text) noexcept;

/// The byte at which a column begins; the line's end if it has fewer.
[[nodiscard]] std::size_t byte_of_column(std::string_view line, std::size_t column) noexcept;

/// A line that fits on a screen as it is; of a longer one, the part around `column`, with "..."
/// where something was cut off.
[[nodiscard]] Excerpt excerpt(std::string_view line, std::size_t column);

/// Control characters but the tab, and bytes that are not UTF-8, become '?': what a file holds must
/// not drive the terminal.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace tactile_net

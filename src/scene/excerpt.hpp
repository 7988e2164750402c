/// @file
/// Parts of a source text, for messages. Columns count code points, from 1; a byte that is not
/// UTF-8 counts as one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tactile_net/system/printable.hpp"  // code_point_size, for who cuts a text

namespace tactile_net {

/// Part of a line, and the column at which it begins.
struct Excerpt {
  std::string text;
  std::size_t column = 1;
};

/// Code points in `text`.
[[nodiscard]] std::size_t code_points(std::string_view text) noexcept;

/// The byte at which a column begins; the line's end if it has fewer.
[[nodiscard]] std::size_t byte_of_column(std::string_view line, std::size_t column) noexcept;

/// A line that fits on a screen as it is; of a longer one, the part around `column`, with "..."
/// where something was cut off.
[[nodiscard]] Excerpt excerpt(std::string_view line, std::size_t column);

}  // namespace tactile_net

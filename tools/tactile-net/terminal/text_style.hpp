/// @file
/// How text is set for whoever reads a stream.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tactile_net::tool {

struct TextStyle {
  std::size_t width = 80;  ///< longest line [columns]
  bool bold = false;       ///< headings may be marked by a terminal's own characters
};

/// Of what is written to a file descriptor: as wide as the terminal that it is, else as COLUMNS
/// says, else 80; from 40 to 100 columns, since longer lines are hard to read. Bold on a terminal
/// alone, and not where NO_COLOR is set (no-color.org) or TERM is "dumb".
[[nodiscard]] TextStyle style_of(int descriptor);

/// The text in lines of at most `width` columns, each but the first behind `indent` blanks. A line
/// is broken at blanks alone, and behind the commas of a list in braces, {a,b,c}; a word that is
/// longer than a line stands on one of its own. Line feeds of the text stay.
///
/// @param first  columns that stand before the text in its first line
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                                  std::size_t first);

}  // namespace tactile_net::tool

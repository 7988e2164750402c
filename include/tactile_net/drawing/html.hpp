/// @file
/// Pieces of an HTML page.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::drawing {

/// Text as HTML.
[[nodiscard]] std::string escaped(std::string_view text);

/// Numbers and units as people write them, for what is read and never parsed: "2.5 us" -> "2.5 µs",
/// "3.04 deg" -> "3.04°", "0.549 +- 0.0857" -> "0.55 ± 0.09", "<=" -> "≤", "1.09e+03" -> "1090" up
/// to a million, "1e-05" -> "1e-5". UTF-8.
[[nodiscard]] std::string typeset(std::string_view text);

/// Words as HTML, typeset: for all but names, in which "1e+03" and "us" are what they are.
[[nodiscard]] std::string words_html(std::string_view text);

/// <tag class="type">html</tag>
[[nodiscard]] std::string enclosed(std::string_view tag, std::string_view html,
                                   std::string_view type = {});

/// The same around words.
[[nodiscard]] std::string element(std::string_view tag, std::string_view words,
                                  std::string_view type = {});

[[nodiscard]] std::string html_list(const std::vector<std::string>& items);

/// How data begin in a page: an element that does nothing, for scripts to read.
inline constexpr std::string_view data_element = "<script type=\"application/json\">";

/// JSON as such an element; what could end it is escaped.
[[nodiscard]] std::string data_html(std::string_view json);

/// A cell's content as HTML.
using CellHtml = std::function<std::string(std::size_t column, const std::string& text)>;

/// The first row is the header. Its words stand with each cell too (data-label), for windows that
/// are too narrow for columns. @param cell  absent: the text, typeset and escaped
[[nodiscard]] std::string html_table(const std::vector<std::vector<std::string>>& rows,
                                     const CellHtml& cell = {});

/// How a page says who has written it, in its first lines.
inline constexpr std::string_view written_by = "<meta name=\"generator\" content=\"tactile-net";

/// A whole page around `body`, which is HTML, in `style`, which is CSS.
[[nodiscard]] std::string html_page(std::string_view title, std::string_view body,
                                    std::string_view style);

}  // namespace tactile_net::drawing

/// @file
/// Pieces of an HTML page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::drawing {

/// Text as HTML.
[[nodiscard]] std::string escaped(std::string_view text);

/// <tag class="type">content</tag>, the content escaped.
[[nodiscard]] std::string element(std::string_view tag, std::string_view content,
                                  std::string_view type = {});

[[nodiscard]] std::string html_list(const std::vector<std::string>& items);

/// The first row is the header.
[[nodiscard]] std::string html_table(const std::vector<std::vector<std::string>>& rows);

/// How a page says who has written it, in its first lines.
inline constexpr std::string_view written_by = "<meta name=\"generator\" content=\"tactile-net";

/// A whole page around `body`, which is HTML; `extra_style` is CSS.
[[nodiscard]] std::string html_page(std::string_view title, std::string_view body,
                                    std::string_view extra_style = {});

}  // namespace tactile_net::drawing

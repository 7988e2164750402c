/// @file
/// How the rows of a text file are cut into fields: the one reader of CSV's fields. Private.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

struct CsvLayout {
  char separator = ',';  ///< ',', ';' or '\t'; ' ' stands for any run of blanks and tabs

  /// Where fields are not separated by commas, numbers may have one in place of the point.
  [[nodiscard]] bool may_have_decimal_comma() const noexcept { return separator != ','; }
};

/// How a line is most likely cut: the line with the names, or one of numbers.
[[nodiscard]] CsvLayout layout_of(std::string_view line);

/// How often `c` stands in a line outside quotes.
[[nodiscard]] std::ptrdiff_t count_outside_quotes(std::string_view line, char c) noexcept;

/// Without surrounding blanks and quotes.
[[nodiscard]] inline std::string_view trimmed(std::string_view field) noexcept {
  const auto is_padding = [](char c) { return c == ' ' || c == '\t' || c == '"'; };
  while (!field.empty() && is_padding(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_padding(field.back())) field.remove_suffix(1);
  return field;
}

/// `take_field` for what is rare: runs of blanks, and quotes around a separator.
[[nodiscard]] std::string_view take_unusual_field(std::string_view& rest, bool& more,
                                                  CsvLayout layout) noexcept;

/// Cuts the first field off a row, as it stands; `more` tells whether another follows.
[[nodiscard]] inline std::string_view take_field(std::string_view& rest, bool& more,
                                                 CsvLayout layout) noexcept {
  if (layout.separator == ' ' || (!rest.empty() && (rest[0] == '"' || rest[0] == ' ')))
    return take_unusual_field(rest, more, layout);
  const std::size_t end = rest.find(layout.separator);
  more = end != std::string_view::npos;
  const std::string_view field = rest.substr(0, end);
  rest.remove_prefix(more ? end + 1 : rest.size());
  return field;
}

/// All fields of a row, as they stand.
[[nodiscard]] std::vector<std::string_view> fields_of(std::string_view row, CsvLayout layout);

/// The text of a field: without the quotes around it, and what it has of them once (RFC 4180).
[[nodiscard]] std::string unquoted(std::string_view field);

/// The fields of the line with the names: where blanks separate, "t [s]" is one.
[[nodiscard]] std::vector<std::string_view> names_of(std::string_view row, CsvLayout layout);

}  // namespace tactile_net

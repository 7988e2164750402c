/// @file
/// What one field of a row holds: a number, or nothing. Private.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

enum class FieldKind {
  number,   ///< finite
  missing,  ///< empty, NaN, NA, an infinity, "#DIV/0!": somebody knew that there is no value
  too_big,  ///< beyond the range of a double
  text,     ///< anything else
};

/// A number with a decimal point, NaN and infinities missing; anything else is text.
[[nodiscard]] inline FieldKind read_with_point(std::string_view field, double& value) {
  // number_from_chars takes no leading '+'.
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  double read = 0.0;
  const auto [end, error] = number_from_chars(field.data(), field.data() + field.size(), read);
  if (end != field.data() + field.size()) return FieldKind::text;
  if (error == std::errc::result_out_of_range) return FieldKind::too_big;
  if (error != std::errc{}) return FieldKind::text;
  value = read;
  return std::isfinite(read) ? FieldKind::number : FieldKind::missing;
}

/// `read_field` for what is no number with a point. @param kind  what it is then
[[nodiscard]] FieldKind read_unusual_field(std::string_view field, FieldKind kind,
                                           bool decimal_comma, double& value);

/// @param field          without surrounding blanks and quotes
/// @param decimal_comma  "1,5" is a number
/// @param value          set for a number, an infinity and NaN
[[nodiscard]] inline FieldKind read_field(std::string_view field, bool decimal_comma,
                                          double& value) {
  const FieldKind kind = read_with_point(field, value);
  return kind == FieldKind::number ? kind : read_unusual_field(field, kind, decimal_comma, value);
}

/// What to do about a field that has commas, or several points, in a number: decimal commas, or
/// separators of thousands. Empty: it is nothing of the kind.
[[nodiscard]] std::string how_to_write(std::string_view field);

/// Why a field is no number, for a message: "'abc' is not a number".
[[nodiscard]] std::string why_no_number(std::string_view field, FieldKind kind);

}  // namespace tactile_net

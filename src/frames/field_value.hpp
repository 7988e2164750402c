/// @file
/// What one field of a row holds: a number, or nothing. Private.
#pragma once

#include <string>
#include <string_view>

namespace tactile_net::frames {

enum class FieldKind {
  number,   ///< finite
  missing,  ///< empty, NaN, NA, an infinity, "#DIV/0!": somebody knew that there is no value
  too_big,  ///< beyond the range of a double
  text,     ///< anything else
};

/// @param field          without surrounding blanks and quotes
/// @param decimal_comma  "1,5" is a number
/// @param value          set for a number only
[[nodiscard]] FieldKind read_field(std::string_view field, bool decimal_comma, double& value);

/// Why a field is no number, for a message: "'abc' is not a number".
[[nodiscard]] std::string why_no_number(std::string_view field, FieldKind kind);

}  // namespace tactile_net::frames

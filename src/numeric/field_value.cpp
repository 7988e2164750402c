#include "numeric/field_value.hpp"

#include <algorithm>
#include <array>

#include "numeric/lower_case.hpp"

namespace tactile_net {
namespace {

/// How spreadsheets, pandas, R, Julia and people write that there is no value; in small letters.
/// NaN and the infinities are numbers to std::from_chars.
constexpr std::array<std::string_view, 20> words = {
    "na",   "n/a", "<na>", "null",    "none",    "nil",    "missing", "-",     "--",     "---",
    "#n/a", "#na", "#nv",  "#div/0!", "#value!", "#wert!", "#ref!",   "#num!", "#zahl!", "#null!"};
constexpr std::size_t longest_word = 7;

bool is_word_for_missing(std::string_view field) {
  if (field.size() > longest_word) return false;
  return std::find(words.begin(), words.end(), lower_case(field)) != words.end();
}

}  // namespace

FieldKind read_unusual_field(std::string_view field, FieldKind kind, bool decimal_comma,
                             double& value) {
  if (field.empty()) return FieldKind::missing;
  if (kind == FieldKind::text && decimal_comma && field.size() < 64) {
    const std::size_t comma = field.find(',');
    if (comma != field.npos && field.find('.') == field.npos) {
      std::string with_point(field);
      with_point[comma] = '.';
      kind = read_with_point(with_point, value);
    }
  }
  return kind == FieldKind::text && is_word_for_missing(field) ? FieldKind::missing : kind;
}

std::string how_to_write(std::string_view field) {
  if (field.find_first_not_of("+-0123456789.,'eE") != field.npos) return {};
  const auto commas = std::count(field.begin(), field.end(), ',');
  const auto points = std::count(field.begin(), field.end(), '.');
  const auto marks = std::count(field.begin(), field.end(), '\'');
  if (commas == 1 && points + marks == 0)
    return "a decimal comma? Where commas separate fields write decimal points; or write the table "
           "with semicolons between fields";
  if (commas + points + marks < 2) return {};
  return "separators of thousands? Write the number without them";
}

std::string why_no_number(std::string_view field, FieldKind kind) {
  if (field.empty()) return "a number is missing";
  const std::string quoted = "'" + std::string(field.substr(0, 40)) + "'";
  if (kind == FieldKind::too_big) return quoted + " is beyond the range of a double";
  double ignored = 0.0;
  return quoted +
         (kind == FieldKind::missing && read_with_point(field, ignored) == FieldKind::missing
              ? " is not finite"
              : " is not a number");
}

}  // namespace tactile_net

#include "numeric/csv_fields.hpp"

#include <algorithm>

#include "numeric/field_value.hpp"

namespace tactile_net {
namespace {

constexpr std::string_view blanks = " \t";

bool all_numbers(std::string_view line, CsvLayout layout) {
  double value = 0.0;
  for (const std::string_view field : fields_of(line, layout)) {
    const FieldKind kind = read_field(trimmed(field), layout.may_have_decimal_comma(), value);
    if (kind != FieldKind::number && kind != FieldKind::missing) return false;
  }
  return true;
}

/// Where the quote that closes the one at `open` stands; doubled ones belong to the field.
std::size_t closing_quote(std::string_view text, std::size_t open) noexcept {
  std::size_t at = text.find('"', open + 1);
  while (at != text.npos && at + 1 < text.size() && text[at + 1] == '"')
    at = text.find('"', at + 2);
  return at;
}

bool begins_unit(std::string_view field) {
  return !field.empty() && (field.front() == '[' || field.front() == '(');
}

}  // namespace

std::ptrdiff_t count_outside_quotes(std::string_view line, char c) noexcept {
  std::ptrdiff_t count = 0;
  bool quoted = false;
  for (const char one : line) {
    if (one == '"') quoted = !quoted;
    if (one == c && !quoted) ++count;
  }
  return count;
}

CsvLayout layout_of(std::string_view line) {
  const auto semicolons = count_outside_quotes(line, ';');
  const auto commas = count_outside_quotes(line, ',');
  const auto tabs = count_outside_quotes(line, '\t');
  if (semicolons > 0 && (semicolons >= commas || all_numbers(line, {';'}))) return {';'};
  if (tabs > 0) {
    // A tab beside a comma is padding.
    const auto beside = [&](std::string_view pair) { return line.find(pair) != line.npos; };
    if (commas == 0 || (!beside(",\t") && !beside("\t,") && all_numbers(line, {'\t'})))
      return {'\t'};
    return {','};
  }
  const std::size_t inner =
      line.find_first_of(blanks, std::min(line.find_first_not_of(blanks), line.size()));
  const bool has_inner_blank =
      inner != line.npos && line.find_first_not_of(blanks, inner) != line.npos;
  if (!has_inner_blank) return {','};
  if (commas == 0) return {' '};
  // "1,5 2,5": blanks between numbers with decimal commas. "1, 5" is two numbers.
  return {line.find(", ") == line.npos && all_numbers(line, {' '}) ? ' ' : ','};
}

std::string_view take_unusual_field(std::string_view& rest, bool& more, CsvLayout layout) noexcept {
  const std::size_t begin = std::min(rest.find_first_not_of(blanks), rest.size());
  if (layout.separator == ' ') rest.remove_prefix(begin);
  // A separator between quotes is none; a quote that is never closed is an ordinary letter.
  std::size_t from = 0;
  const std::size_t quote = layout.separator == ' ' ? 0 : begin;
  if (quote < rest.size() && rest[quote] == '"') {
    const std::size_t closing = closing_quote(rest, quote);
    if (closing != rest.npos) from = closing;
  }
  const std::size_t end = layout.separator == ' ' ? rest.find_first_of(blanks, from)
                                                  : rest.find(layout.separator, from);
  const std::string_view field = rest.substr(0, end);
  more = end != rest.npos;
  rest.remove_prefix(more ? end + 1 : rest.size());
  if (layout.separator != ' ') return field;
  rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  more = !rest.empty();
  return field;
}

std::vector<std::string_view> fields_of(std::string_view row, CsvLayout layout) {
  std::vector<std::string_view> fields;
  for (bool more = true; more;) fields.push_back(take_field(row, more, layout));
  return fields;
}

std::string unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"' && field[i + 1] == '"' && i + 2 < field.size()) ++i;
  }
  return text;
}

std::vector<std::string_view> names_of(std::string_view row, CsvLayout layout) {
  std::vector<std::string_view> names;
  for (const std::string_view field : fields_of(row, layout)) {
    if (layout.separator == ' ' && begins_unit(field) && !names.empty()) {
      const char* begin = names.back().data();
      names.back() = {begin, static_cast<std::size_t>(field.data() + field.size() - begin)};
    } else {
      names.push_back(field);
    }
  }
  return names;
}

}  // namespace tactile_net

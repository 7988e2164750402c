#include "frames/csv_header.hpp"

#include <algorithm>

#include "frames/field_value.hpp"

namespace tactile_net::frames {
namespace {

/// "# ", as numpy.savetxt and most programs write it, and MATLAB's "% ".
bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('%'); }

std::string_view without_mark(std::string_view comment) {
  while (!comment.empty() && (comment.front() == '#' || comment.front() == '%'))
    comment.remove_prefix(1);
  return comment;
}

/// 0, 1, 2, ... or 1, 2, 3, ...: names, as pandas writes them for columns without names. Fewer than
/// four could as well be readings.
bool counts(const std::vector<std::string_view>& fields) {
  std::size_t numbers = 0;
  std::size_t first = 0;
  for (const std::string_view field : fields) {
    const std::string_view text = trimmed(field);
    if (text.empty()) continue;
    if (numbers == 0) first = text == "1" ? 1 : 0;
    if (text != std::to_string(first + numbers)) return false;
    ++numbers;
  }
  return numbers >= 4;
}

/// Whether these are the fields of a row: numbers, values that are missing, and what begins with a
/// digit, as dates do.
bool is_row(const std::vector<std::string_view>& fields, CsvLayout layout) {
  if (counts(fields)) return false;
  bool any = false;
  for (const std::string_view field : fields) {
    const std::string_view text = trimmed(field);
    double value = 0.0;
    const FieldKind kind = read_field(text, layout.may_have_decimal_comma(), value);
    const bool has_digit = !text.empty() && text.front() >= '0' && text.front() <= '9';
    if (kind == FieldKind::text && !has_digit) return false;
    any = any || kind == FieldKind::number;
  }
  return any;
}

void set_names(CsvHeader& header, std::string_view line, std::string_view part, CsvLayout layout) {
  header.text = line;
  for (const std::string_view name : names_of(part, layout)) {
    header.names.emplace_back(trimmed(name));
    header.at.push_back(static_cast<std::size_t>(name.data() - line.data()));
  }
}

}  // namespace

std::optional<CsvHeader> read_header(TextLines& lines, TextLines::Got& got) {
  CsvHeader header;
  std::string comment;
  std::optional<CsvLayout> stated;
  for (got = lines.next(); got == TextLines::Got::line; got = lines.next()) {
    const std::string_view line = lines.line();
    // Excel's own way to say what separates fields: "sep=;".
    if (lines.number() == 1 && line.size() == 5 && line.starts_with("sep="))
      stated = CsvLayout{line[4]};
    else if (is_comment(line))
      comment = line;
    else
      break;
  }
  if (got == TextLines::Got::end && !comment.empty()) {  // names in a comment, and no frame
    const std::string_view part = without_mark(comment);
    set_names(header, comment, part, layout_of(part));
    return header;
  }
  if (got != TextLines::Got::line) return std::nullopt;

  const std::string_view line = lines.line();
  header.layout = stated.value_or(layout_of(line));
  const std::vector<std::string_view> fields = fields_of(line, header.layout);
  if (!is_row(fields, header.layout)) {
    set_names(header, line, line, header.layout);
    return header;
  }
  header.row_pending = true;
  header.row_fields = fields.size();
  const std::string_view part = without_mark(comment);
  const CsvLayout layout = layout_of(part);
  const auto names = names_of(part, layout);
  if (names.size() == fields.size() && !is_row(names, layout))
    set_names(header, comment, part, layout);
  return header;
}

}  // namespace tactile_net::frames

#include "scene/csv_table.hpp"

#include <cstdint>
#include <string_view>

#include "numeric/csv_fields.hpp"
#include "scene/document.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20;

/// Without surrounding blanks; quotes stay.
std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view around = " \t\r";
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(around) - first + 1);
}

/// The next line; the rest stays in `text`.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

/// Spreadsheets of half the world write ; or tabs for they need the comma: a header without any is
/// theirs.
char separator_of(std::string_view header) {
  for (const char separator : {',', ';', '\t'})
    if (count_outside_quotes(header, separator) > 0) return separator;
  return ',';
}

/// "1,5" where commas do not separate: 1.5. "1,234,5" and "1.234,5" stay, and are no numbers.
void point_for_comma(std::string& field) {
  const std::size_t comma = field.find(',');
  if (comma == std::string::npos || field.find_first_not_of("+-0123456789,eE") != field.npos ||
      field.find(',', comma + 1) != field.npos)
    return;
  field[comma] = '.';
}

std::vector<std::string> texts_in(std::string_view line, char separator) {
  std::vector<std::string> texts;
  for (const std::string_view field : fields_of(line, {separator})) {
    texts.push_back(unquoted(without_blanks(field)));
    if (separator != ',') point_for_comma(texts.back());
  }
  return texts;
}

bool is_row(std::string_view content) { return !content.empty() && content.front() != '#'; }

constexpr const char* no_header = "it has 0 rows, not even a header";

std::string text_of(const std::filesystem::path& path) {
  try {
    return bounded_text(path, largest_file, "");
  } catch (const InputError& error) {
    throw std::runtime_error(error.diagnostics().front().message);
  }
}

}  // namespace

std::runtime_error error_in_line(std::size_t line, const std::string& what) {
  return std::runtime_error("line " + std::to_string(line) + ": " + what);
}

std::vector<std::string> read_csv_header(const std::filesystem::path& path) {
  const std::string held = text_of(path);
  std::string_view text = without_byte_order_mark(held);
  while (!text.empty())
    if (const auto content = take_line(text); is_row(without_blanks(content)))
      return texts_in(content, separator_of(content));
  throw std::runtime_error(no_header);
}

CsvTable read_csv_table(const std::filesystem::path& path) {
  const std::string held = text_of(path);
  std::string_view text = without_byte_order_mark(held);
  CsvTable table;
  char separator = ',';
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::string_view content = take_line(text);
    if (!is_row(without_blanks(content))) continue;
    if (table.header.line == 0) separator = separator_of(content);
    CsvTable::Row row{line, texts_in(content, separator)};
    if (table.header.line == 0)
      table.header = std::move(row);
    else if (row.fields.size() != table.header.fields.size())
      throw error_in_line(line, "it has " + std::to_string(row.fields.size()) +
                                    " fields, the header " +
                                    std::to_string(table.header.fields.size()));
    else
      table.rows.push_back(std::move(row));
  }
  if (table.header.line == 0) throw std::runtime_error(no_header);
  return table;
}

}  // namespace tactile_net

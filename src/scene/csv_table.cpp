#include "scene/csv_table.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "scene/document.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{16} << 20;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What stands before the separator; the rest stays in `text`.
std::string_view cut(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

/// Spreadsheets of half the world write ; or tabs for they need the comma: a header without any is
/// theirs.
char separator_of(std::string_view header) {
  if (header.find(',') != std::string_view::npos) return ',';
  for (const char separator : {';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
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

std::vector<std::string> fields_of(std::string_view line, char separator) {
  std::vector<std::string> fields;
  const auto separators = std::count(line.begin(), line.end(), separator);
  for (std::ptrdiff_t i = 0; i <= separators; ++i) {
    fields.emplace_back(trimmed(cut(line, separator)));
    if (separator != ',') point_for_comma(fields.back());
  }
  return fields;
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
    if (const auto content = cut(text, '\n'); is_row(trimmed(content)))
      return fields_of(content, separator_of(content));
  throw std::runtime_error(no_header);
}

CsvTable read_csv_table(const std::filesystem::path& path) {
  const std::string held = text_of(path);
  std::string_view text = without_byte_order_mark(held);
  CsvTable table;
  char separator = ',';
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::string_view content = cut(text, '\n');
    if (!is_row(trimmed(content))) continue;
    if (table.header.line == 0) separator = separator_of(content);
    CsvTable::Row row{line, fields_of(content, separator)};
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

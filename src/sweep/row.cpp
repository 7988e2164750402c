#include "tactile_net/sweep/row.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/csv_fields.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::sweep {
namespace {

// A row's fields, but for the axes', which stand behind the index: each column once, for writer and
// reader.

std::string written(const std::string& text) {
  return text.find_first_of(",\"\n\r") == std::string::npos ? text : csv_quoted(text);
}
std::string written(std::uint64_t number) { return std::to_string(number); }
std::string written(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? shortest(*number) : std::string();
}
std::string written(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    if (!text.empty()) text += ' ';
    append_number(text, number);
  }
  return text;
}

bool read(const std::string& field, std::string& text) {
  text = field;
  return true;
}
bool read(const std::string& field, std::uint64_t& number) {
  const auto read = whole_number(field);
  number = read.value_or(0);
  return read.has_value();
}
bool read(const std::string& field, std::optional<double>& number) {
  number.reset();
  double value = 0.0;
  if (field.empty()) return true;
  if (!read_number(field, value)) return false;
  number = value;
  return true;
}
bool read(const std::string& field, std::vector<double>& numbers) {
  numbers.clear();
  if (field.empty()) return true;
  for (const std::string_view text : split(field, ' '))
    if (!read_number(text, numbers.emplace_back())) return false;
  return true;
}

struct Column {
  std::string_view name;
  std::string (*write)(const Row& row);
  bool (*read)(const std::string& field, Row& row);
  std::optional<Kept> kept{};  ///< absent: every row has it
};

template <auto member>
constexpr Column column(std::string_view name) {
  return {name, [](const Row& row) { return written(row.*member); },
          [](const std::string& field, Row& row) { return read(field, row.*member); }};
}

template <auto member>
Column column(Kept kept) {
  Column column = sweep::column<member>(name(kept));
  column.kept = kept;
  return column;
}

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = {
      column<&Row::seed>("seed"),
      column<&Row::method>("method"),
      column<&Row::alpha>(Kept::alpha),
      column<&Row::verdict>("verdict"),
      column<&Row::error>(Kept::error),
      column<&Row::error_tangential>(Kept::error_tangential),
      column<&Row::mean_error>(Kept::mean_error),
      column<&Row::force>(Kept::force),
      column<&Row::tangential_force>(Kept::tangential_force),
      column<&Row::centre_y>(Kept::centre_y),
      column<&Row::centre_z>(Kept::centre_z),
      column<&Row::condition>(Kept::condition),
      column<&Row::error_bound>(Kept::error_bound),
      column<&Row::failure>("failure"),
      column<&Row::version>("version"),
      column<&Row::instructions>("instructions"),
      column<&Row::readings>(Kept::readings),
      column<&Row::truth>(Kept::truth),
      column<&Row::tractions>(Kept::tractions),
  };
  return columns;
}

std::vector<Column> columns_of(const std::vector<Kept>& keep) {
  std::vector<Column> columns;
  for (const Column& column : all_columns())
    if (!column.kept || std::find(keep.begin(), keep.end(), *column.kept) != keep.end())
      columns.push_back(column);
  return columns;
}

}  // namespace

std::string header(const std::vector<std::string>& axes, const std::vector<Kept>& keep) {
  std::string line = "index";
  for (const std::string& axis : axes) line += ',' + written(axis);
  for (const Column& column : columns_of(keep)) (line += ',') += column.name;
  return line;
}

std::string csv(const Row& row, const std::vector<Kept>& keep) {
  std::string line = std::to_string(row.index);
  for (const std::string& value : row.values) line += ',' + written(value);
  for (const Column& column : columns_of(keep)) line += ',' + column.write(row);
  return line;
}

std::optional<Row> row_in(std::string_view line, std::size_t axes, const std::vector<Kept>& keep) {
  const std::vector<Column> columns = columns_of(keep);
  const std::vector<std::string> all = fields(line);
  Row row;
  std::uint64_t index = 0;
  if (all.size() != 1 + axes + std::size(columns) || !read(all.front(), index)) return std::nullopt;
  row.index = index;
  const auto first = all.begin() + 1;
  row.values.assign(first, first + static_cast<std::ptrdiff_t>(axes));
  for (std::size_t k = 0; k < std::size(columns); ++k)
    if (!columns[k].read(all[1 + axes + k], row)) return std::nullopt;
  return row;
}

std::vector<std::string> fields(std::string_view line) {
  std::vector<std::string> all;
  for (const std::string_view field : fields_of(line, {','})) all.push_back(unquoted(field));
  return all;
}

}  // namespace tactile_net::sweep

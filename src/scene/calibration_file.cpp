#include "scene/calibration_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/csv_table.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr std::string_view reading_column = "reading";

void check_header(const CsvTable::Row& header, std::span<const std::string_view> known) {
  for (const std::string& name : header.fields) {
    if (name != reading_column && std::find(known.begin(), known.end(), name) == known.end()) {
      std::string all(reading_column);
      for (const std::string_view one : known) all += ", " + std::string(one);
      throw error_in_line(header.line, "a column has another name than " + all);
    }
    if (std::count(header.fields.begin(), header.fields.end(), name) > 1)
      throw error_in_line(header.line, "a column stands there twice");
  }
}

}  // namespace

CalibrationColumns read_calibration_file(const std::filesystem::path& path,
                                         std::span<const std::string_view> known,
                                         std::span<const std::string> readings) {
  const CsvTable table = read_csv_table(path);
  check_header(table.header, known);
  CalibrationColumns columns;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& [line, fields] = table.rows[i];
    if (i == readings.size()) break;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const std::string& name = table.header.fields[k];
      double number = 0.0;
      if (name == reading_column) {
        if (fields[k] != readings[i])
          throw error_in_line(line, "this row belongs to " + readings[i]);
      } else if (!read_number(fields[k], number) || !std::isfinite(number)) {
        throw error_in_line(line, name + " is not a finite number");
      } else {
        columns[name].push_back(number);
      }
    }
  }
  if (table.rows.size() != readings.size())
    throw std::runtime_error("it has " + std::to_string(table.rows.size()) + " rows, the array " +
                             std::to_string(readings.size()) + " readings: one row each");
  return columns;
}

}  // namespace tactile_net

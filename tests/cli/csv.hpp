/// @file
/// Texts with commas, as numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tactile_net {

inline std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

/// The rows below the header; an empty field is NaN, words are left out.
inline std::vector<std::vector<double>> csv_rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    rows.emplace_back();
    for (const std::string& field : fields_of(line))
      if (field.empty() || field.find_first_not_of("0123456789+-.e") == std::string::npos)
        rows.back().push_back(field.empty() ? std::nan("") : std::stod(field));
  }
  return rows;
}

/// The numbers of a row by the header's names; words are left out.
using CsvRow = std::map<std::string, double>;
inline std::vector<CsvRow> named_csv_rows(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = fields_of(line);
  std::vector<CsvRow> rows;
  while (std::getline(lines, line)) {
    CsvRow& row = rows.emplace_back();
    const std::vector<std::string> fields = fields_of(line);
    for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i)
      if (fields[i].find_first_not_of("0123456789+-.e") == std::string::npos)
        row[names[i]] = fields[i].empty() ? std::nan("") : std::stod(fields[i]);
  }
  return rows;
}

}  // namespace tactile_net

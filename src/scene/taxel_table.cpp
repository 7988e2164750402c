#include "scene/taxel_table.hpp"

#include <cmath>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net {
namespace {

/// "y" of "y [mm]".
std::string without_unit(const std::string& name) {
  const std::size_t open = name.find('[');
  if (open == std::string::npos || open == 0) return name;
  return name.substr(0, name.find_last_not_of(' ', open - 1) + 1);
}

void check_unit(const CsvTable::Row& header, const std::string& name, const Unit& length) {
  const std::size_t open = name.find('[');
  if (open == std::string::npos) return;
  if (name.substr(open + 1, name.find(']') - open - 1) != length.name)
    throw error_in_line(header.line, "a length has another unit than the scene's, " +
                                         std::string(length.name) +
                                         ": convert it, or state that unit under [units]");
}

}  // namespace

TaxelTable::TaxelTable(const std::filesystem::path& path, std::span<const std::string_view> known,
                       const Unit& length)
    : table_(read_csv_table(path)),
      known_(known.begin(), known.end()),
      length_(length),
      places_(known.size()) {
  const Row& header = table_.header;
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    check_unit(header, header.fields[k], length);
    const auto found = std::find(known_.begin(), known_.end(), without_unit(header.fields[k]));
    if (found == known_.end())
      throw error_in_line(header.line,
                          "a column has another name than " +
                              join(std::vector<std::string>(known.begin(), known.end()), ", "));
    auto& place = places_[static_cast<std::size_t>(found - known_.begin())];
    if (place) throw error_in_line(header.line, "a column stands there twice");
    place = k;
  }
}

void TaxelTable::require(std::size_t column, bool elsewhere, const std::string& advice) const {
  if (!has(column) && !elsewhere)
    throw error_in_line(table_.header.line,
                        "there is no column " + std::string(known_[column]) + advice);
}

const std::vector<TaxelTable::Row>& TaxelTable::rows(std::size_t least, std::size_t most) const {
  const std::size_t count = table_.rows.size();
  if (count < least || count > most)
    throw std::runtime_error("it has " + std::to_string(count) + " taxels: from " +
                             std::to_string(least) + " to " + std::to_string(most) +
                             " are possible");
  return table_.rows;
}

double TaxelTable::length(const Row& row, std::size_t column) const {
  double number = 0.0;
  if (!read_number(text(row, column), number) || !std::isfinite(number))
    throw error_in_line(row.line, std::string(known_[column]) + " is not a finite number");
  return length_.to_si(number);
}

bool has_column(const std::filesystem::path& path, std::string_view name) noexcept {
  try {
    const std::vector<std::string> fields = read_csv_header(path);
    return std::any_of(fields.begin(), fields.end(),
                       [&](const std::string& field) { return without_unit(field) == name; });
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace tactile_net

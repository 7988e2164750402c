/// @file
/// Taxels as CSV: a row per taxel, columns in any order. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scene/csv_table.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net {

/// The header may give the unit of a length, "y [mm]". What is wrong is thrown as
/// std::runtime_error, with its line.
class TaxelTable {
 public:
  using Row = CsvTable::Row;

  /// @param known   the names that columns may have; later they are called by their index
  /// @param length  the unit of the scene's lengths
  TaxelTable(const std::filesystem::path& path, std::span<const std::string_view> known,
             const Unit& length);

  [[nodiscard]] bool has(std::size_t column) const { return places_[column].has_value(); }

  /// @param elsewhere  the scene says it of all taxels
  /// @param advice     ", and the scene states no sensor.depth"
  void require(std::size_t column, bool elsewhere, const std::string& advice) const;

  /// @throw std::runtime_error  there are fewer or more
  [[nodiscard]] const std::vector<Row>& rows(std::size_t least, std::size_t most) const;

  [[nodiscard]] const std::string& text(const Row& row, std::size_t column) const {
    return row.fields[*places_[column]];
  }
  /// In SI.
  [[nodiscard]] double length(const Row& row, std::size_t column) const;

  /// A list with blanks between.
  [[nodiscard]] std::vector<Quantity> quantities(const Row& row, std::size_t column,
                                                 std::span<const Quantity> all) const {
    std::vector<Quantity> result;
    std::istringstream words(text(row, column));
    for (std::string word; words >> word;) {
      const auto found = std::find_if(all.begin(), all.end(),
                                      [&](Quantity quantity) { return name(quantity) == word; });
      if (found == all.end()) {
        std::string names;
        for (const Quantity quantity : all)
          names += (names.empty() ? "" : ", ") + std::string(name(quantity));
        throw error_in_line(row.line, "reads names something else than " + names);
      }
      result.push_back(*found);
    }
    if (result.empty()) throw error_in_line(row.line, "reads names no quantity");
    return result;
  }

 private:
  CsvTable table_;
  std::vector<std::string_view> known_;
  Unit length_;
  std::vector<std::optional<std::size_t>> places_;  // where each known column stands
};

/// Whether the header of a CSV has such a column, whatever its unit; false of a file without one.
[[nodiscard]] bool has_column(const std::filesystem::path& path, std::string_view name) noexcept;

}  // namespace tactile_net

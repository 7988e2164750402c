/// @file
/// From files of rows to a table: nothing missing, in the study's order, with a hash that is the
/// same whoever computed what.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/sweep/rows_file.hpp"

namespace tactile_net::sweep {

/// Points from one up to, but not including, another.
struct PointRange {
  std::size_t first = 0;
  std::size_t end = most_points;  ///< may lie beyond the study's last

  [[nodiscard]] bool has(std::size_t index) const noexcept { return first <= index && index < end; }
  [[nodiscard]] std::size_t end_in(std::size_t points) const noexcept {
    return std::min(end, points);
  }
};

/// "10:20": ten points. @throw std::invalid_argument  it is no range, or an empty one
[[nodiscard]] PointRange point_range_in(std::string_view text);

struct Table {
  std::string title{};  ///< of the study
  std::string study{};  ///< `Study::hash`
  std::vector<std::string> axes{};
  SweepUnits units{};
  std::vector<Kept> keep{};
  std::size_t points = 0;
  std::vector<Row> rows{};  ///< by index, and of a point in the order of the scene's methods
  std::string csv{};        ///< the same: a header, and a line for each
  std::string sha256{};     ///< of `csv`
};

/// Points that no file has.
class MissingPoints : public std::runtime_error {
 public:
  /// @param missing  their indices, rising, at least one
  MissingPoints(const std::vector<std::size_t>& missing, std::size_t points);
};

/// @throw MissingPoints  of the range: naming how many, and which
[[nodiscard]] Table table(const Rows& rows, const PointRange& range = {});

/// All files together, of one study.
/// @throw InputError     there is no file, or not all are of one study; as `Rows::add`
/// @throw MissingPoints  as `table`
[[nodiscard]] Table merge(std::span<const std::filesystem::path> files,
                          const PointRange& range = {});

}  // namespace tactile_net::sweep

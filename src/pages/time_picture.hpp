/// @file
/// Private. Pictures over time, and others whose lines stretch with the window while their words do
/// not: an <svg> of one unit a column and 100 high, its numbers beside it as HTML.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {

/// The least and the greatest of what a picture shows.
struct Range {
  double low = 0.0;
  double high = 0.0;

  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return !(high > low); }
  /// From 0 at the top to 100 at the bottom.
  [[nodiscard]] double at(double value) const { return 100.0 * (high - value) / (high - low); }
};

/// What stands below a picture: at its left end, in the middle, at its right end.
using Ends = std::vector<std::string>;

/// The picture with the range's numbers at its left and `below`.
///
/// @param unit    of the range's numbers: what they are multiplied by, and the label with the upper
/// @param label   what it shows, for whoever hears the page
/// @param type    "low", "strip" and more, for the style
/// @param inside  SVG
[[nodiscard]] std::string stretched_picture(std::size_t columns, const Range& range,
                                            const ScaledUnit& unit, std::string_view label,
                                            std::string_view type, const std::string& inside,
                                            const Ends& below);

/// A value of every column; not finite: a gap.
using ColumnValue = std::function<double(std::size_t column)>;

[[nodiscard]] std::string path_of(std::size_t columns, const Range& range, const ColumnValue& value,
                                  std::string_view type);
[[nodiscard]] std::string area_of(std::size_t columns, const Range& range, const ColumnValue& low,
                                  const ColumnValue& high, std::string_view type);
/// A level line.
[[nodiscard]] std::string level_line(std::size_t columns, const Range& range, double level,
                                     std::string_view type);

/// y over the columns, largest y on top: blue and red for normal, orange and purple for tangential.
/// @param value  of a taxel in a column, from -1 to 1
[[nodiscard]] std::string heat_map(
    std::size_t columns, std::size_t taxels, Traction traction,
    const std::function<double(std::size_t column, std::size_t taxel)>& value);

}  // namespace tactile_net::pages

/// @file
/// Numbers of every frame with their bands, for pictures over time. Private.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "report/json/values.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {

/// A value of every frame with its band, in a unit of its own.
struct Course {
  const char* label;
  const char* colour;
  std::vector<double> values{}, low{}, high{};
  bool dashed = false;
  bool any_interval = false, any_deviation = false;  // what bands are of

  [[nodiscard]] bool has_band() const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (low[i] < high[i]) return true;
    return false;
  }
  void add(double value, double below, double above) {
    values.push_back(value);
    low.push_back(below);
    high.push_back(above);
  }
  void add(const std::optional<Uncertain>& number) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (number)
      add(number->value, *number, number->value, number->value);
    else
      add(none, none, none);
  }
  /// A value whose band has the ends of its interval, or lies two deviations to each side where it
  /// has none, and reaches over `lowest` and `highest` too.
  void add(double value, const Uncertain& known, double lowest, double highest) {
    any_interval = any_interval || known.interval;
    any_deviation = any_deviation || (!known.interval && known.deviation > 0.0);
    const double below = known.interval ? known.interval->low : value - 2.0 * known.deviation;
    const double above = known.interval ? known.interval->high : value + 2.0 * known.deviation;
    add(value, std::min(below, lowest), std::max(above, highest));
  }
};

/// What bands are of; empty: there are none.
[[nodiscard]] std::string bands_in_words(double level, bool interval, bool deviation);

/// Null where nothing is known of any frame.
/// @param level  of the intervals
[[nodiscard]] Json course_json(const std::optional<Units>& units, double level,
                               const std::string& title, const std::string& axis,
                               Dimension dimension, const std::vector<Course>& courses);

}  // namespace tactile_net::report

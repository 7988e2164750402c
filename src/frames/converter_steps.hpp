/// @file
/// What a converter's steps do to the values of one reading. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <vector>

namespace tactile_net::frames {

/// The step that all values are whole multiples of apart; 0: there is none.
[[nodiscard]] inline double converter_step(const std::set<double>& values) {
  double step = 0.0;
  for (auto it = values.begin(); it != values.end() && std::next(it) != values.end(); ++it)
    if (const double apart = *std::next(it) - *it; step == 0.0 || apart < step) step = apart;
  const bool is_grid = step > 0.0 && std::all_of(values.begin(), values.end(), [&](double one) {
                         const double steps = (one - *values.begin()) / step;
                         return std::abs(steps - std::round(steps)) < 1e-3;
                       });
  return is_grid ? step : 0.0;
}

/// Whether `count` of so many values share the uppermost step by chance, of steps that are `share`
/// of the range: more often than once in 10,000 readings.
[[nodiscard]] inline bool is_chance(std::size_t count, std::size_t values, double share) {
  double likely = 1.0;
  for (std::size_t i = 1; i < count; ++i)
    likely *= share * static_cast<double>(values - i) / static_cast<double>(i);
  return likely > 1e-4;
}

/// How many values are the one farthest from `middle`, exactly, where that is
/// more than chance: the end of a range.
///
/// @param values  at least 1
/// @param least   what is nearer to `middle` is no end
/// @param step    of the values; 0: none
/// @return        0: no end of a range shows
[[nodiscard]] inline std::size_t times_at_end(const std::vector<double>& values, double middle,
                                              double least, double step) {
  double most = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    const double apart = std::abs(value - middle);
    if (apart > most) count = 0;
    most = std::max(most, apart);
    if (apart == most) ++count;
  }
  return count > 1 && most > least && !is_chance(count, values.size(), step / most) ? count : 0;
}

}  // namespace tactile_net::frames

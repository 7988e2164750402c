/// @file
/// Private. From a type's fields that are numbers, of lines or of skins, the header and the rows of
/// CSV and of tables.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {

template <Described T>
[[nodiscard]] std::vector<std::string> columns_of(bool skin) {
  std::vector<std::string> names;
  for_each_field<T>([&](const auto& one) {
    if (is_of(one.of, skin)) names.emplace_back(one.key);
  });
  return names;
}

/// Yes and no are 1 and 0.
template <Described T>
[[nodiscard]] std::vector<double> values_of(const T& row, bool skin) {
  std::vector<double> values;
  for_each_field<T>([&](const auto& one) {
    if (is_of(one.of, skin)) values.push_back(static_cast<double>(std::invoke(one.access, row)));
  });
  return values;
}

/// The values in words, for a terminal.
template <Described T>
[[nodiscard]] std::vector<std::string> cells_of(const T& row, bool skin) {
  std::vector<std::string> cells;
  for (const double value : values_of(row, skin)) cells.push_back(brief(value));
  return cells;
}

}  // namespace tactile_net::report

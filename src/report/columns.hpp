/// @file
/// Private. From a type's fields that are numbers, of lines or of skins, the header and the rows of
/// CSV and of tables. A value with its deviation is two columns, with its interval four.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "numeric/named.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::report {

/// A place on a skin, y and z.
using UncertainPlace = std::optional<std::array<Uncertain, 2>>;
/// What curved skins alone have, along the sensor's x, y and z.
using UncertainVector = IfAny<std::array<Uncertain, 3>>;
using ExactVector = IfAny<std::array<double, 3>>;

/// @param intervals  of values that have a deviation
/// @param curved     with what curved skins alone have
/// @param name       of a column: (key, measure) -> text
template <Described T>
[[nodiscard]] std::vector<std::string> columns_of(
    bool skin, bool intervals = false, bool curved = false,
    const std::function<std::string(std::string_view, Measure)>& name =
        [](std::string_view key, Measure) { return std::string(key); }) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& column) {
    names.insert(names.end(), {column, column + "_deviation"});
    if (intervals) names.insert(names.end(), {column + "_low", column + "_high"});
  };
  for_each_field<T>([&]<class Access>(const Field<Access>& one) {
    if (!is_of(one.of, skin)) return;
    using Value = FieldValue<T, Access>;
    const std::string column = name(one.key, one.measure);
    if constexpr (std::is_convertible_v<Value, std::optional<Uncertain>>) {
      add(column);
    } else if constexpr (std::is_same_v<Value, UncertainPlace>) {
      add(column + "_y");
      add(column + "_z");
    } else if constexpr (std::is_same_v<Value, UncertainVector>) {
      if (!curved) return;
      for (const char* const axis : {"_x", "_y", "_z"}) add(column + axis);
    } else if constexpr (std::is_same_v<Value, ExactVector>) {
      if (!curved) return;
      for (const char* const axis : {"_x", "_y", "_z"}) names.push_back(column + axis);
    } else {
      names.push_back(column);
    }
  });
  return names;
}

/// Yes and no are 1 and 0; NaN where there is none.
template <Described T>
[[nodiscard]] std::vector<double> values_of(const T& row, bool skin, bool intervals = false,
                                            bool curved = false) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  const auto add = [&](const std::optional<Uncertain>& known) {
    values.push_back(known ? known->value : none);
    values.push_back(known ? known->deviation : none);
    if (!intervals) return;
    values.push_back(known && known->interval ? known->interval->low : none);
    values.push_back(known && known->interval ? known->interval->high : none);
  };
  for_each_field<T>([&]<class Access>(const Field<Access>& one) {
    if (!is_of(one.of, skin)) return;
    const auto& value = std::invoke(one.access, row);
    using Value = FieldValue<T, Access>;
    if constexpr (std::is_convertible_v<Value, std::optional<Uncertain>>) {
      add(value);
    } else if constexpr (std::is_same_v<Value, UncertainPlace>) {
      for (const std::size_t axis : {0U, 1U})
        add(value ? std::optional((*value)[axis]) : std::nullopt);
    } else if constexpr (std::is_same_v<Value, UncertainVector>) {
      for (std::size_t axis = 0; curved && axis < 3; ++axis)
        add(value.value ? std::optional((*value.value)[axis]) : std::nullopt);
    } else if constexpr (std::is_same_v<Value, ExactVector>) {
      for (std::size_t axis = 0; curved && axis < 3; ++axis)
        values.push_back(value.value ? (*value.value)[axis] : none);
    } else {
      values.push_back(static_cast<double>(value));
    }
  });
  return values;
}

/// A value as a field of CSV; what is not known is empty. @return quoted where it is text
[[nodiscard]] std::string csv_field(const auto& value) {
  using Value = std::remove_cvref_t<decltype(value)>;
  if constexpr (std::is_enum_v<Value>)
    return std::string(name_in<Enumerators<Value>::all>(value));
  else if constexpr (std::is_arithmetic_v<Value>)
    return shortest(value);
  else if constexpr (std::is_convertible_v<Value, std::string_view>)
    return std::string_view(value).empty() ? std::string() : csv_quoted(value);
  else
    return value ? csv_field(*value) : std::string();
}

/// Fields that are numbers or texts as CSV: the header, then a row each.
template <Described T>
[[nodiscard]] std::string csv_of(const std::vector<T>& rows, bool skin) {
  std::string text = join(columns_of<T>(skin), ",") + '\n';
  for (const T& row : rows) {
    std::vector<std::string> fields;
    for_each_field<T>([&](const auto& one) {
      if (is_of(one.of, skin)) fields.push_back(csv_field(std::invoke(one.access, row)));
    });
    text += join(fields, ",") + '\n';
  }
  return text;
}

/// The values in words, for a terminal.
template <Described T>
[[nodiscard]] std::vector<std::string> cells_of(const T& row, bool skin) {
  std::vector<std::string> cells;
  for (const double value : values_of(row, skin)) cells.push_back(brief(value));
  return cells;
}

}  // namespace tactile_net::report

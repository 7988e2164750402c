/// @file
/// Private. The numbers of a result with their names as people read them: the rows and columns of
/// tables in the terminal and on pages are made from its fields.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "report/load_dimension.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {

struct ToldNumber {
  std::string label{};
  Measure measure = Measure::none;
  std::optional<Uncertain> number{};  ///< without a deviation where it is exact
};

/// "slip margin" of slip_margin, "normal force" of a load that is called normal.
[[nodiscard]] inline std::string label_of(std::string_view key, Measure measure) {
  std::string label(key);
  std::replace(label.begin(), label.end(), '_', ' ');
  return measure == Measure::load && label != "force" ? label + " force" : label;
}

/// The numbers among the fields that the sensor has, as many of every result; of a place on a skin
/// two.
template <class T, class... Access>
[[nodiscard]] std::vector<ToldNumber> told_numbers(const T& result,
                                                   const std::tuple<Field<Access>...>& fields,
                                                   bool skin) {
  std::vector<ToldNumber> told;
  const auto uncertain = []<class Number>(const Number& number) -> std::optional<Uncertain> {
    if constexpr (std::is_convertible_v<Number, std::optional<Uncertain>>) {
      return number;
    } else {
      const std::optional<double> exact = number;
      return exact ? std::optional(Uncertain{*exact, 0.0}) : std::nullopt;
    }
  };
  const auto add = [&](const auto& one) {
    if (!is_of(one.of, skin)) return;
    const auto value = std::invoke(one.access, result);
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>> ||
                  std::is_convertible_v<Value, std::optional<Uncertain>>) {
      told.push_back({label_of(one.key, one.measure), one.measure, uncertain(value)});
    } else if constexpr (std::is_same_v<Value, std::optional<std::array<double, 2>>> ||
                         std::is_same_v<Value, std::optional<std::array<Uncertain, 2>>>) {
      for (std::size_t axis = 0; axis < 2; ++axis)
        told.push_back({label_of(one.key, one.measure) + (axis == 0 ? ", y" : ", z"), one.measure,
                        value ? uncertain((*value)[axis]) : std::nullopt});
    } else if constexpr (std::is_same_v<Value, IfAny<std::array<Uncertain, 3>>>) {
      constexpr std::array axes = {", x", ", y", ", z"};
      for (std::size_t axis = 0; axis < axes.size(); ++axis)
        told.push_back({label_of(one.key, one.measure) + axes[axis], one.measure,
                        value.value ? std::optional((*value.value)[axis]) : std::nullopt});
    }
  };
  std::apply([&](const auto&... one) { (add(one), ...); }, fields);
  return told;
}

/// @param load  what a load is of this sensor
[[nodiscard]] constexpr Dimension dimension_of(Measure measure, Dimension load) noexcept {
  switch (measure) {
    case Measure::length:
    case Measure::area:  // in its square
      return Dimension::length;
    case Measure::stress:
      return Dimension::stress;
    case Measure::load:
      return load;
    case Measure::moment:
      return Dimension::moment;
    default:
      return Dimension::none;
  }
}

/// The unit that suits numbers up to `largest`; without [units] it has no label.
[[nodiscard]] inline ScaledUnit unit_of(Measure measure, Dimension load,
                                        const std::optional<Units>& units, double largest) {
  const Dimension dimension = dimension_of(measure, load);
  if (measure != Measure::area) return axis_unit(units, dimension, largest);
  if (!units) return {"", 1.0};
  const ScaledUnit side = axis_unit(units, dimension, std::sqrt(largest));
  return {side.label + "²", side.factor * side.factor};
}

}  // namespace tactile_net::report

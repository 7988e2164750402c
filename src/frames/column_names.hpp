/// @file
/// What the name of a column means, however it is spelt. Private.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/units.hpp"

namespace tactile_net::frames {

/// A name taken apart: "Stress_X[07] [kPa]" is stem "stress_x", number 7, unit "kPa".
struct ColumnName {
  std::string stem{};                   ///< small letters, words joined by '_', no number
  std::optional<std::size_t> number{};  ///< at its end: "_7", "[7]", "(7)", "007"
  std::string unit{};                   ///< in brackets behind it

  /// The one spelling of all that mean the same: "stress_x_7".
  [[nodiscard]] std::string plain() const;
};

[[nodiscard]] ColumnName column_name(std::string_view text);

/// Columns that share a stem and differ by a number.
struct ColumnGroup {
  std::string stem{};
  std::map<std::size_t, std::size_t> field_of{};  ///< places of the columns, by number
  bool twice = false;                             ///< a number stands twice

  /// From 0 or 1, without a gap.
  [[nodiscard]] bool is_complete() const noexcept;
};

/// In the order of their first columns; those without a number are in none.
[[nodiscard]] std::vector<ColumnGroup> column_groups(std::span<const ColumnName> names);

/// The stem of a quantity's channel: "stress_x", "stress_x@1".
[[nodiscard]] bool means_quantity(std::string_view stem);

/// What a name says of times: "t", "time", "T", "t [s]", "time_ms", "header.stamp.sec".
struct TimeName {
  std::optional<Unit> unit{};  ///< that it states, to seconds
  std::string clock{};         ///< without the unit: two columns of one clock are parts of a time
};

/// @return  nothing: it is no column of times
[[nodiscard]] std::optional<TimeName> time_name(const ColumnName& name);

/// A stem that says nothing of the quantity: "", "taxel", "ch".
[[nodiscard]] bool is_generic(std::string_view stem);

}  // namespace tactile_net::frames

/// @file
/// What the name of a column means, however it is spelt. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

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

/// "t", "time", "T", "t [s]", "time_s": a column of times, if its unit is one of time.
[[nodiscard]] bool means_time(const ColumnName& name);

/// A stem that says nothing of the quantity: "", "taxel", "ch".
[[nodiscard]] bool is_generic(std::string_view stem);

}  // namespace tactile_net::frames

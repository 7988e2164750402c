/// @file
/// The names of enumerators, from one table for both ways. Private.
///
///     constexpr Named<Base> bases[] = {{Base::bonded, "bonded"},
///                                      {Base::frictionless, "frictionless"}};
///     name_in<bases>(Base::bonded)      "bonded"
///     named_in<bases>("frictionless")   Base::frictionless; absent for any other text
///
/// A table that lacks an enumerator, or lists them in another order, does not compile.
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <type_traits>

namespace tactile_net {

/// One row. A table may use a row type of its own, with more columns beside these two.
template <typename Enum>
struct Named {
  Enum value;
  std::string_view name;
};

/// Whether `value` is an enumerator: the compiler spells it "Base::bonded" if so, else "(Base)2".
template <auto value>
[[nodiscard]] consteval bool is_enumerator() {
  const std::string_view spelled = __PRETTY_FUNCTION__;
  const std::size_t start = spelled.rfind("value = ") + std::string_view("value = ").size();
  return spelled[start] != '(';
}

/// Whether the rows are the enumerators 0, 1, 2, ... in their order, every one, each with a name.
template <const auto& table>
[[nodiscard]] consteval bool names_all() {
  using Enum = std::remove_cvref_t<decltype(table[0].value)>;
  for (std::size_t i = 0; i < std::size(table); ++i)
    if (static_cast<std::size_t>(table[i].value) != i || table[i].name.empty()) return false;
  return !is_enumerator<static_cast<Enum>(std::size(table))>();
}

/// The row of `value`.
template <const auto& table>
[[nodiscard]] constexpr const auto& row_in(
    std::remove_cvref_t<decltype(table[0].value)> value) noexcept {
  static_assert(names_all<table>(), "the table needs one row per enumerator, in their order");
  return table[static_cast<std::size_t>(value)];
}

template <const auto& table>
[[nodiscard]] constexpr std::string_view name_in(
    std::remove_cvref_t<decltype(table[0].value)> value) noexcept {
  return row_in<table>(value).name;
}

template <const auto& table>
[[nodiscard]] constexpr auto named_in(std::string_view name) noexcept
    -> std::optional<std::remove_cvref_t<decltype(table[0].value)>> {
  static_assert(names_all<table>(), "the table needs one row per enumerator, in their order");
  for (const auto& row : table)
    if (row.name == name) return row.value;
  return std::nullopt;
}

}  // namespace tactile_net

/// @file
/// A result told once: its numbers, each with a key and a sentence. JSON, its schema, CSV, tables
/// of the terminal and the tables of the docs are made from it.
///
///     struct Peak {
///       std::size_t frame = 0;
///       double force = 0.0;
///
///       static constexpr auto described = std::tuple{
///           field("frame", &Peak::frame, "The frame that presses hardest."),
///           field("force", &Peak::force, Measure::load, "What it presses with.")};
///     };
///
/// What a value may be follows from its type: an optional one may be null, one that is `IfAny` is
/// left out where there is none, and a struct with fields stands inside.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace tactile_net {

/// What a number of a result measures. A load is one along the depth on a line, and one of a point
/// on a skin; a reading measures what its channel does.
enum class Measure {
  none,     ///< a ratio, a count, a word
  length,   ///< m
  area,     ///< m^2
  stress,   ///< Pa
  load,     ///< N/m, of a skin N
  moment,   ///< N m
  angle,    ///< rad
  reading,  ///< the unit of the channel
  time,     ///< s
  rate,     ///< 1/s

  speed,        ///< m/s
  force,        ///< N
  frequency,    ///< Hz
  voltage,      ///< V
  current,      ///< A
  power,        ///< W
  resistance,   ///< ohm
  conductance,  ///< S
  capacitance,  ///< F
  memory,       ///< bytes
};

/// "m", "N/m, of a skin N"; empty: it has none.
[[nodiscard]] constexpr std::string_view unit_symbol(Measure measure) noexcept {
  switch (measure) {
    case Measure::none:
      break;
    case Measure::length:
      return "m";
    case Measure::area:
      return "m^2";
    case Measure::stress:
      return "Pa";
    case Measure::load:
      return "N/m, of a skin N";
    case Measure::moment:
      return "N m";
    case Measure::angle:
      return "rad";
    case Measure::reading:
      return "as the channel";
    case Measure::time:
      return "s";
    case Measure::rate:
      return "1/s";
    case Measure::speed:
      return "m/s";
    case Measure::force:
      return "N";
    case Measure::frequency:
      return "Hz";
    case Measure::voltage:
      return "V";
    case Measure::current:
      return "A";
    case Measure::power:
      return "W";
    case Measure::resistance:
      return "ohm";
    case Measure::conductance:
      return "S";
    case Measure::capacitance:
      return "F";
    case Measure::memory:
      return "byte";
  }
  return {};
}

/// Which sensors a field is there for.
enum class Of { both, lines, skins };

[[nodiscard]] constexpr bool is_of(Of field, bool skin) noexcept {
  return field == Of::both || (field == Of::skins) == skin;
}

template <class Access>
struct Field {
  std::string_view key;
  Access access;  ///< std::invoke(access, result) is the value
  Measure measure;
  std::string_view text;  ///< a sentence
  Of of;
};

template <class Access>
[[nodiscard]] constexpr Field<Access> field(std::string_view key, Access access, Measure measure,
                                            std::string_view text, Of of = Of::both) {
  return {key, access, measure, text, of};
}

template <class Access>
[[nodiscard]] constexpr Field<Access> field(std::string_view key, Access access,
                                            std::string_view text, Of of = Of::both) {
  return {key, access, Measure::none, text, of};
}

/// The fields of a type, `all`: its own, or those of a specialization for a type that has none.
template <class T>
struct Fields;

template <class T>
requires requires { T::described; }
struct Fields<T> {
  static constexpr const auto& all = T::described;
};

template <class T>
concept Described = requires {
  Fields<T>::all;
};

/// Calls `call` with each field of T, in their order.
template <Described T>
constexpr void for_each_field(const auto& call) {
  std::apply([&](const auto&... one) { (call(one), ...); }, Fields<T>::all);
}

/// The type of a field's value.
template <class T, class Access>
using FieldValue = std::remove_cvref_t<std::invoke_result_t<Access, const T&>>;

/// The fields of a part of a result as the result's own.
template <class Part, class... Access>
[[nodiscard]] constexpr auto within(Part part, const std::tuple<Field<Access>...>& fields) {
  return std::apply(
      [&](const auto&... one) {
        return std::tuple{field(
            one.key,
            [part, access = one.access](const auto& whole) {
              return std::invoke(access, std::invoke(part, whole));
            },
            one.measure, one.text, one.of)...};
      },
      fields);
}

/// A number as a value that may be null: nothing where it is not finite.
[[nodiscard]] inline std::optional<double> if_finite(double number) {
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// A value whose key is left out where there is none.
template <class T>
struct IfAny {
  std::optional<T> value{};
};

/// A value of an enumeration: its name in files, and a sentence.
template <class Enum>
struct Enumerator {
  Enum value;
  std::string_view name;
  std::string_view text;
};

/// The enumerators of an enumeration, `all`, a table of `Enumerator` or of what has its members.
/// Specialized where the enumeration is named.
template <class Enum>
struct Enumerators;

/// The name in that table; empty: it has no such row.
template <class Enum>
[[nodiscard]] constexpr std::string_view enumerator_name(Enum value) noexcept {
  for (const auto& row : Enumerators<Enum>::all)
    if (row.value == value) return row.name;
  return {};
}

}  // namespace tactile_net

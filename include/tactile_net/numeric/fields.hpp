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
  stress,   ///< Pa
  load,     ///< N/m, of a skin N
  moment,   ///< N m
  angle,    ///< rad
  reading,  ///< the unit of the channel
  time,     ///< s
  rate,     ///< 1/s
};

/// "m", "N/m, of a skin N"; empty: it has none.
[[nodiscard]] constexpr std::string_view unit_symbol(Measure measure) noexcept {
  switch (measure) {
    case Measure::none:
      break;
    case Measure::length:
      return "m";
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

/// A value whose key is left out where there is none.
template <class T>
struct IfAny {
  std::optional<T> value{};
};

/// The enumerators of an enumeration, `all`, by a table of `Named` (numeric/named.hpp) whose rows
/// have a `text` too, a sentence each. Specialized where the enumeration is named.
template <class Enum>
struct Enumerators;

}  // namespace tactile_net

/// @file
/// Which field of a row is which reading. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

struct ColumnMatch {
  static constexpr std::ptrdiff_t ignored_field = -1;
  static constexpr std::ptrdiff_t time_field = -2;
  static constexpr std::ptrdiff_t nanoseconds_field = -3;  ///< of whole seconds in the time's field

  std::vector<std::ptrdiff_t> target{};  ///< per field of a row: index into the values, or above
  bool has_time = false;
  std::optional<Unit> time_unit{};  ///< that the name states, to seconds
  /// Per value: what makes the unit that is wanted of the header's; empty: nothing is converted.
  std::vector<Unit> factors{};
  std::vector<std::string> ignored{};  ///< names of fields that are not read
  std::vector<std::string> notes{};    ///< what was taken for granted
};

/// The file's columns are not those that are wanted.
struct NoMatch : std::runtime_error {
  NoMatch(const std::string& message, std::string what_to_do, std::size_t at = 0)
      : std::runtime_error(message), hint(std::move(what_to_do)), field(at) {}
  std::string hint;
  std::size_t field;  ///< of the header, from 0, that it is about
};

/// By the names in the header: as they are wanted; else in another spelling (case, zeros in front,
/// brackets, a unit behind, taxels counted from 1); else names that say nothing but a number
/// ("taxel_0", "1"), if there are exactly as many as are wanted; else, of one channel, the only
/// name that so many columns share ("Druck_1"). Where `wanted.places` says where they stand, by
/// that.
///
/// @throw NoMatch                a column is missing, or it is not clear which one it is
/// @throw std::invalid_argument  as `column_places`
[[nodiscard]] ColumnMatch match_columns(std::span<const std::string> header,
                                        const WantedColumns& wanted);

/// The same for rows without names, of so many fields: by `wanted.places`, or if there are exactly
/// as many as are wanted.
[[nodiscard]] ColumnMatch match_unnamed(std::size_t fields, const WantedColumns& wanted);

}  // namespace tactile_net::frames

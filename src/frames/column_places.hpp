/// @file
/// Columns by their places in a row, as `--columns` lists them. Private.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net::frames {

struct ColumnPlaces {
  std::vector<std::size_t> readings{};       ///< from 0, in the order of the readings
  std::optional<std::size_t> time{};         ///< from 0
  std::optional<std::size_t> nanoseconds{};  ///< of whole seconds in `time`
};

/// @param list       "2-42", "t=1,4-44", "a,b,c"; "t=1+2": seconds and nanoseconds apart
/// @param row        how many columns the file has
/// @param wanted     how many readings there must be; nothing: any number
/// @param place_of   the place of a name, from 0; nothing: there is none
/// @throw std::invalid_argument  the list is malformed, names a column that is not there or one
///                               twice, or not as many as are wanted
[[nodiscard]] ColumnPlaces column_places(
    std::string_view list, std::size_t row, std::optional<std::size_t> wanted,
    const std::function<std::optional<std::size_t>(std::string_view)>& place_of);

/// The list that takes so many readings as the last columns of a row, after others: "2-42".
[[nodiscard]] std::string places_after(std::size_t others, std::size_t wanted);

}  // namespace tactile_net::frames

/// @file
/// A sweep's rows taken together: what one axis does, whatever the others have.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/sweep/merge.hpp"

namespace tactile_net::sweep {

/// Some rows of one method.
struct Group {
  std::size_t rows = 0;
  std::size_t trusted = 0;                ///< with the verdict ok
  std::size_t failed = 0;                 ///< without an answer
  std::optional<double> median_error{};   ///< of `Row::error`; absent: no row has one
  std::optional<double> largest_error{};  ///< the same
  std::optional<double> median_alpha{};
};

[[nodiscard]] Group group(std::span<const Row* const> rows);

/// The methods that rows have, in their first's order; rows of points that failed have none.
[[nodiscard]] std::vector<std::string> methods(const Table& table);

/// A method's rows.
[[nodiscard]] std::vector<const Row*> of_method(const Table& table, std::string_view method);

/// Rows by the value that they have on an axis, which may be drawn: in the rising order of numbers
/// where all values are, else in the order in which they come.
struct Part {
  std::string value{};
  std::optional<double> number{};
  std::vector<const Row*> rows{};
};
[[nodiscard]] std::vector<Part> by_value(std::span<const Row* const> rows, std::size_t axis);

/// An axis with more values than these is drawn as points, and listed nowhere.
inline constexpr std::size_t most_listed_values = 40;

/// Whether what one axis does can be told value by value: not of a repeat, whose number says
/// nothing.
/// @param parts  by the axis' values
[[nodiscard]] bool can_be_listed(const Table& table, std::size_t axis,
                                 const std::vector<Part>& parts);

/// Points of which no row has an answer.
[[nodiscard]] std::size_t failed_points(const Table& table);

/// Why points or methods have no answer, each reason once, with how many rows have it; the most
/// frequent first.
[[nodiscard]] std::vector<std::pair<std::string, std::size_t>> failures(const Table& table);

}  // namespace tactile_net::sweep

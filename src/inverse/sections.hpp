/// @file
/// How a long array is cut into sections. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// Where sections begin and how they hand over to each other. Lengths in taxels.
struct Sections {
  std::size_t length = 0;
  std::vector<std::size_t> starts{};

  /// Section s's taper at a place between taxels, 0 the array's first. All add up to 1.
  [[nodiscard]] double weight(std::size_t s, double place) const noexcept;

 private:
  [[nodiscard]] double risen(std::size_t s, double place) const noexcept;
};

/// As many as an array's length asks for: one of an array that is hardly longer than a section.
[[nodiscard]] Sections sections_of(const SensorArray& array, const LineProblemOptions& options);

}  // namespace tactile_net

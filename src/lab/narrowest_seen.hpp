/// @file
/// The search for the narrowest contact that is seen. Private.
#pragma once

#include <optional>

namespace tactile_net::lab {

/// Half of its width.
///
/// @param least     narrower ones cannot be seen
/// @param most      nothing where no width up to it is seen
/// @param accuracy  of the answer, a share of it
[[nodiscard]] inline std::optional<double> narrowest_seen(double least, double most,
                                                          double accuracy, const auto& is_seen) {
  constexpr double step = 1.25;
  double seen = least;
  while (seen <= most && !is_seen(seen)) seen *= step;
  if (!(seen <= most)) return std::nullopt;
  double unseen = seen / step;
  while (seen - unseen > accuracy * seen) {
    const double middle = 0.5 * (seen + unseen);
    (is_seen(middle) ? seen : unseen) = middle;
  }
  return seen;
}

}  // namespace tactile_net::lab

/// @file
/// Which contact on a line is nearest to slipping: the rule of controllers and of solvers. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "realtime/touching_cells.hpp"

namespace tactile_net {

/// Values of a line, from `first` to before `last`.
struct LineContact {
  std::size_t first, last;
  std::size_t contacts;  ///< of which it is one
};

/// Finds the contacts on a line: stretches above `least_share` of the highest pressure; where it
/// falls below that between two places, these are of two, and the line is parted between them where
/// it presses least. Calls `use(first, last)` with the part of each from left to right, if there
/// are two at least: one contact alone has the whole line. O(values); no allocation.
///
/// @param p      normal tractions
/// @param least  sum of p that a contact has at least: the noise's
/// @return how many contacts there are
inline std::size_t for_each_contact(const double* p, std::size_t count, double least,
                                    const auto& use) noexcept {
  const double limit = least_share * *std::max_element(p, p + count);
  // Calls with the first value of each stretch above the limit, what follows its last, and its sum.
  const auto for_each_stretch = [&](const auto& take) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!(p[i] > limit)) continue;
      const std::size_t first = i;
      double sum = 0.0;
      for (; i < count && p[i] > limit; ++i) sum += p[i];
      take(first, i, sum);
    }
  };
  double strongest = 0.0;
  for_each_stretch(
      [&](std::size_t, std::size_t, double sum) { strongest = std::max(strongest, sum); });
  least = std::max(least, least_share * strongest);
  std::size_t contacts = 0;
  std::size_t begin = 0;  // of the contact that was found last, and what follows its stretch
  std::size_t end = 0;
  for_each_stretch([&](std::size_t first, std::size_t last, double sum) {
    if (!(sum > least)) return;
    if (contacts++ > 0) {
      const auto cut = static_cast<std::size_t>(std::min_element(p + end, p + first) - p);
      use(begin, cut);
      begin = cut;
    }
    end = last;
  });
  if (contacts > 1) use(begin, count);
  return contacts;
}

/// Of the contacts on a line the one that needs the most friction; one contact alone has the whole
/// line. O(values); no allocation.
///
/// @param p, q   normal and tangential tractions
/// @param least  as `for_each_contact` takes it
inline LineContact nearest_to_slipping(const double* p, const double* q, std::size_t count,
                                       double least) noexcept {
  LineContact nearest{0, count, 0};
  double most = -1.0;
  nearest.contacts = for_each_contact(p, count, least, [&](std::size_t first, std::size_t last) {
    double press = 0.0;
    double drag = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      press += p[i];
      drag += q[i];
    }
    if (!(press > 0.0) || !(std::abs(drag) > most * press)) return;
    most = std::abs(drag) / press;
    nearest.first = first;
    nearest.last = last;
  });
  if (nearest.contacts < 2) return {0, count, 1};
  return nearest;
}

}  // namespace tactile_net

/// @file
/// The concentrated force that a traction field amounts to (thesis 6.3-6.5).
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

/// Force and moment of tractions: sums over the surface's values, h apart. Tractions on a flat
/// surface have no moment about their centre of pressure: the tangential ones act along the very
/// line on which it lies, and a torsional moment about the surface's normal does not exist in the
/// plane.
struct Resultant {
  double normal = 0.0;      ///< F_v = h sum f_v [N/m]
  double tangential = 0.0;  ///< F_t = h sum f_t [N/m]
  double moment = 0.0;      ///< h sum y f_v, about y = 0 [N]

  /// y* = moment / normal [m]; absent if F_v <= 0, where no point of action exists.
  [[nodiscard]] std::optional<double> centre() const noexcept {
    return normal > 0.0 ? std::optional(moment / normal) : std::nullopt;
  }
  /// atan2(F_t, F_v) from the surface's normal [rad]; absent if F_v <= 0.
  [[nodiscard]] std::optional<double> angle() const noexcept {
    return normal > 0.0 ? std::optional(std::atan2(tangential, normal)) : std::nullopt;
  }
};

/// Resultant of the values from `first` to before `last`, with nothing elsewhere; exact for hats
/// and for line loads. O(values).
///
/// @param normal      `surface.count` values
/// @param tangential  as many, or none: frictionless
[[nodiscard]] inline Resultant resultant_between(std::size_t first, std::size_t last,
                                                 std::span<const double> normal,
                                                 std::span<const double> tangential,
                                                 const Surface& surface) noexcept {
  Resultant sum;
  for (std::size_t i = first; i < last; ++i) {
    sum.normal += surface.spacing * normal[i];
    sum.moment += surface.spacing * surface.position(i) * normal[i];
    if (!tangential.empty()) sum.tangential += surface.spacing * tangential[i];
  }
  return sum;
}

/// Of all of them.
[[nodiscard]] inline Resultant resultant_of(std::span<const double> normal,
                                            std::span<const double> tangential,
                                            const Surface& surface) noexcept {
  return resultant_between(0, normal.size(), normal, tangential, surface);
}

/// Resultant of values at equal distances, centred on y = 0. @param pitch  their distance [m]
[[nodiscard]] inline Resultant resultant_of(std::span<const double> normal,
                                            std::span<const double> tangential,
                                            double pitch) noexcept {
  return resultant_of(normal, tangential, Surface{.count = normal.size(), .spacing = pitch});
}

}  // namespace tactile_net

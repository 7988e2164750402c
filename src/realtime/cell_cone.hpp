/// @file
/// The point of a cell's friction cone next to its tractions: the rule of controllers and of
/// solvers. Private.
#pragma once

namespace tactile_net {

/// The normal traction there, and what drags are multiplied by.
struct CellCone {
  double normal;
  double shrunk;
};

/// What drags are added to before they divide: nothing beside any that is not 0, and 0 over it is
/// 0. Choosing another divisor instead would be undone by compilers, which divide first and choose
/// then.
inline constexpr double least_drag = 0x1p-900;

/// Inside, on the surface where what sticks out goes at a right angle to it, or the tip. Without
/// branches; no operation is invalid or a division by zero.
///
/// @param normal, drag  p, and |q| >= 0; in a unit in which the largest is no smaller than 1e-250
/// @param limit  of friction, > 0
/// @param share  1 / (1 + limit^2)
[[nodiscard, gnu::always_inline]] inline CellCone cell_cone(double normal, double drag,
                                                            double limit, double share) noexcept {
  const double along = (normal + limit * drag) * share;
  const bool inside = drag <= limit * normal;
  const bool tip = !(along > 0.0);
  const double to = inside ? normal : tip ? 0.0 : along;
  return {to, inside ? 1.0 : limit * to / (drag + least_drag)};
}

}  // namespace tactile_net

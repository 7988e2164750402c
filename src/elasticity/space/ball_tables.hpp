/// @file
/// The readings of a layer on a rigid ball: functions of the arc. Private.
#pragma once

#include "elasticity/space/layer_table.hpp"
#include "elasticity/space/radial_panels.hpp"

namespace tactile_net {

/// The functions of `LayerTable` of a layer that is bonded to a rigid ball, or to the wall of a
/// round hole: r is the arc along the surface, and axes are turned from the load to the place
/// along it. Whole readings, the thickness and a unit point force as units, displacements times
/// 2 G.
///
/// Each is a sum over the spherical harmonics of all degrees, whose amplitudes (`BallModes`) fall
/// as (1 - depth / radius)^n. It costs O(radius / depth): from `farthest_ball` thicknesses of
/// radius on ten sums at smaller radii are interpolated (ball_sums.hpp).
class BallTables {
 public:
  /// @param nu         Poisson's ratio, [0, 0.5]
  /// @param curvature  thickness over radius: in (0, 1) on a ball, < 0 in a hole
  /// @param depth      in (0, 1], in units of the thickness
  BallTables(double nu, double curvature, double depth);

  using Panels = RadialPanels<20>;

  /// f / r^j at an arc r in [0, end()).
  [[nodiscard]] Panels::At at(double r) const noexcept { return panels_.at(r); }

  /// The antipode, or where less is left than 1e-15 of the largest.
  [[nodiscard]] double end() const noexcept { return panels_.end(); }

 private:
  void add(double nu, double curvature, double depth, double weight);

  Panels panels_;
};

}  // namespace tactile_net

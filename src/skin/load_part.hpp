/// @file
/// A contact as a sum of tractions of one profile each, on an ellipse. Private.
#pragma once

#include <array>
#include <vector>

#include "tactile_net/elasticity/space/disc.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net {

/// A vector in the surface.
struct SurfaceVector {
  double y = 0.0;
  double z = 0.0;
};

/// Tractions force * profile on the ellipse with the half axes a (turned from y towards z) and b.
/// In the ellipse's own coordinates, (u, v), it is the unit disc: profile = a unit force's traction
/// on that disc, over a b. A twist has a force that turns around the middle, in place of one.
class LoadPart {
 public:
  LoadPart(DiscProfile profile, const SkinContact& contact, double scale,
           const std::array<double, 3>& force, double torsion) noexcept;

  [[nodiscard]] double traction(SkinTraction component, double y, double z) const noexcept;
  [[nodiscard]] SkinWrench resultant() const noexcept;
  [[nodiscard]] SkinSupport support() const noexcept;

  /// (u, v) of a place.
  [[nodiscard]] SurfaceVector inside(double y, double z) const noexcept;
  /// The place of (u, v), from the middle [m].
  [[nodiscard]] SurfaceVector from_middle(double u, double v) const noexcept;
  /// The force of the twist at (u, v) [N].
  [[nodiscard]] SurfaceVector twist(double u, double v) const noexcept;

  DiscProfile profile;
  double y, z;  ///< of the middle [m]
  double a, b;  ///< [m]
  std::array<double, 3> force;
  double torsion;

 private:
  double cosine_, sine_;  // of the angle
};

/// Whole, what sticks, what twists: the first is as large as the contact. Only the twist has a
/// torsion, and no force.
[[nodiscard]] std::vector<LoadPart> parts(const SkinContact& contact);

}  // namespace tactile_net

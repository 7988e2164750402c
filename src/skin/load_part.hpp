/// @file
/// A contact as a sum of tractions of one profile each, on an ellipse. Private.
#pragma once

#include <array>
#include <cstddef>

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
  LoadPart() = default;
  LoadPart(DiscProfile own_profile, const SkinContact& contact, double scale,
           const std::array<double, 3>& own_force, double own_torsion) noexcept;

  [[nodiscard]] double traction(Traction component, double y, double z) const noexcept;
  [[nodiscard]] SkinWrench resultant() const noexcept;
  [[nodiscard]] SkinSupport support() const noexcept;

  /// (u, v) of a place.
  [[nodiscard]] SurfaceVector inside(double y, double z) const noexcept;
  /// The place of (u, v), from the middle [m].
  [[nodiscard]] SurfaceVector from_middle(double u, double v) const noexcept;
  /// The force of the twist at (u, v) [N].
  [[nodiscard]] SurfaceVector twist(double u, double v) const noexcept;

  DiscProfile profile = DiscProfile::sphere;
  double y = 0.0;  ///< of the middle [m]
  double z = 0.0;
  double a = 1.0;  ///< [m]
  double b = 1.0;
  std::array<double, 3> force{};
  double torsion = 0.0;

 private:
  double cosine_ = 1.0;  // of the angle
  double sine_ = 0.0;
};

/// Whole, what sticks, what twists: the first is as large as the contact. Only the twist has a
/// torsion, and no force.
class LoadParts {
 public:
  void add(const LoadPart& part) noexcept { all_[count_++] = part; }
  [[nodiscard]] const LoadPart* begin() const noexcept { return all_.data(); }
  [[nodiscard]] const LoadPart* end() const noexcept { return all_.data() + count_; }
  [[nodiscard]] const LoadPart& front() const noexcept { return all_.front(); }

 private:
  std::array<LoadPart, 3> all_{};
  std::size_t count_ = 0;
};

[[nodiscard]] LoadParts parts(const SkinContact& contact) noexcept;

}  // namespace tactile_net

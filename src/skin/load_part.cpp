#include "skin/load_part.hpp"

#include <cmath>
#include <numbers>

namespace tactile_net {
namespace {

using std::numbers::pi;

/// How the force of a contact of one curvature (or one cone) grows with its size, as a power; 0:
/// its size does not change.
struct ShapeTraits {
  DiscProfile profile;
  int growth;
};

ShapeTraits shape_traits(SkinShape shape) noexcept {
  switch (shape) {
    case SkinShape::sphere:
    case SkinShape::ellipsoid:
      return {DiscProfile::sphere, 3};
    case SkinShape::punch:
      return {DiscProfile::punch, 0};
    case SkinShape::cone:
      return {DiscProfile::cone, 2};
  }
  return {DiscProfile::sphere, 3};
}

}  // namespace

LoadPart::LoadPart(DiscProfile own_profile, const SkinContact& contact, double scale,
                   const std::array<double, 3>& own_force, double own_torsion) noexcept
    : profile(own_profile),
      y(contact.y),
      z(contact.z),
      a(scale * contact.radius),
      b(scale * (contact.shape == SkinShape::ellipsoid ? contact.second_radius : contact.radius)),
      force(own_force),
      torsion(own_torsion),
      // A circle looks the same from all sides.
      cosine_(a == b ? 1.0 : std::cos(contact.angle)),
      sine_(a == b ? 0.0 : std::sin(contact.angle)) {}

SurfaceVector LoadPart::inside(double from_y, double from_z) const noexcept {
  const double dy = from_y - y;
  const double dz = from_z - z;
  return {(cosine_ * dy + sine_ * dz) / a, (cosine_ * dz - sine_ * dy) / b};
}

SurfaceVector LoadPart::from_middle(double u, double v) const noexcept {
  return {cosine_ * (a * u) - sine_ * (b * v), sine_ * (a * u) + cosine_ * (b * v)};
}

/// Across the way r from the middle, and as long: its torsion is that of 3 / (2 pi a b) sqrt(1 -
/// s^2) over the ellipse, (a^2 + b^2) / 5 a length squared.
SurfaceVector LoadPart::twist(double u, double v) const noexcept {
  const double per_length = 5.0 * torsion / (a / b + b / a);
  const SurfaceVector r = from_middle(u, v);
  return {-(per_length * (r.z / a) / b), per_length * (r.y / a) / b};
}

double LoadPart::traction(Traction component, double at_y, double at_z) const noexcept {
  const auto [u, v] = inside(at_y, at_z);
  const double s = std::hypot(u, v);
  if (!(s <= 1.0)) return 0.0;
  double own = force[static_cast<std::size_t>(component)];
  if (torsion != 0.0 && component != Traction::normal)
    own = component == Traction::tangential_y ? twist(u, v).y : twist(u, v).z;
  return own == 0.0 ? 0.0 : tactile_net::traction(Disc{profile, 1.0, own}, s) / a / b;
}

SkinWrench LoadPart::resultant() const noexcept {
  return {.force = force,
          .moment_y = y * force[0],
          .moment_z = z * force[0],
          .torque = torsion + y * force[2] - z * force[1]};
}

SkinSupport LoadPart::support() const noexcept {
  const double half_y = std::hypot(a * cosine_, b * sine_);
  const double half_z = std::hypot(a * sine_, b * cosine_);
  return {y - half_y, y + half_y, z - half_z, z + half_z};
}

LoadParts parts(const SkinContact& contact) noexcept {
  const auto [profile, growth] = shape_traits(contact.shape);
  const double drag = contact.friction * contact.force;
  const double drag_y = drag * std::cos(contact.direction);
  const double drag_z = drag * std::sin(contact.direction);
  LoadParts all;
  all.add({profile, contact, 1.0, {contact.force, drag_y, drag_z}, 0.0});
  if (contact.stick > 0.0 && drag != 0.0) {
    const double share = std::pow(contact.stick, growth);
    all.add({profile, contact, contact.stick, {0.0, -share * drag_y, -share * drag_z}, 0.0});
  }
  // A twist has a sphere's root, whatever the profile of what presses.
  if (contact.torsion != 0.0)
    all.add({DiscProfile::sphere, contact, 1.0, {0.0, 0.0, 0.0}, contact.torsion});
  return all;
}

}  // namespace tactile_net

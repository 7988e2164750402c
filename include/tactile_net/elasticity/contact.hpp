/// @file
/// Loads on the surface whose traction is known exactly.
///
/// Every contact knows its traction at a point, the force between two points (the exact integral of
/// the traction) and its resultant. Forces are per unit length out of plane [N/m], tractions [Pa].
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Profile of a rigid indenter; t = y - center, |t| <= a = half_width, P = force:
///
///     cylinder  2 P / (pi a^2) sqrt(a^2 - t^2)           (Hertz; Johnson 1985, 4.2c)
///     punch     P / (pi sqrt((a + e)^2 - t^2))           (flat, edge e; Johnson 1985, 2.8)
///     wedge     P / (pi a) arccosh(a / |t|)              (Johnson 1985, 5.2)
///
/// The punch with e = 0 is infinite at t = +-a, the wedge at t = 0; both integrate to a finite
/// force.
enum class Shape { cylinder, punch, wedge };

struct RigidContact {
  Shape shape = Shape::cylinder;
  double center = 0.0;      ///< [m]
  double half_width = 1.0;  ///< a [m], > 0
  double force = 1.0;       ///< P [N/m]; the resultant, except for a punch with edge > 0
  double edge = 0.0;        ///< e [m], >= 0; punch only
  double friction = 0.0;    ///< f_t = friction * f_v at every point
};

/// Tractions given by their values at equally spaced points, linear in between and falling to zero
/// one pitch beyond the first and the last point: the resultant is pitch * sum of the values.
struct SampledTractions {
  double first = 0.0;                ///< position of the first value [m]
  double pitch = 1.0;                ///< distance between values [m], > 0
  std::vector<double> normal{};      ///< [Pa]
  std::vector<double> tangential{};  ///< [Pa], as many as `normal`, or none: frictionless
};

using Contact = std::variant<RigidContact, SampledTractions>;

/// @throw std::invalid_argument  a value is out of its range or not finite
void check(const Contact& contact);

/// Traction [Pa] at y [m]; infinite, with the sign of the load, where the profile is singular; 0
/// outside the contact, for NaN and for tangential_z, which no line load has. A point that is the
/// place of a sampled value but for rounding has exactly that value.
[[nodiscard]] double traction(const Contact& contact, Traction component, double y) noexcept;

/// Force [N/m] on the surface between `from` and `to` [m], from <= to, infinity allowed: the
/// integral in closed form, correct to an ulp or two of the resultant.
[[nodiscard]] double force_between(const Contact& contact, Traction component, double from,
                                   double to) noexcept;

/// Force of the whole contact [N/m]: `force_between` over all of the surface.
[[nodiscard]] double resultant(const Contact& contact, Traction component) noexcept;

/// A strip of the surface, from `from` to `to` [m].
struct Interval {
  double from = 0.0;
  double to = 0.0;
};
/// The strip that a contact loads [m].
[[nodiscard]] Interval support(const Contact& contact) noexcept;

/// Points where the traction is infinite [m]: none, the apex of a wedge, the edges of a punch.
[[nodiscard]] std::vector<double> singular_points(const Contact& contact);

/// True if the contact has a tangential traction anywhere.
[[nodiscard]] bool has_friction(const Contact& contact) noexcept;

}  // namespace tactile_net

/// @file
/// What presses on a skin: loads whose traction, cells' means and resultants are known exactly.
///
/// Frame and signs as in elasticity/quantity.hpp: tractions act on the skin, p along +x, q_y along
/// +y, q_z along +z.
///
///     const SkinLoad finger = SkinContact{.radius = 2e-3, .force = 1.5, .friction = 0.4};
///     traction(finger, Traction::tangential_y, 0.0, 1e-3);      // [Pa]
///     resultant(finger).force[1];                               // 0.6 N
///     cell_means(std::span(&finger, 1), grid_of(skin));         // as a solver's unknowns
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

/// Profile of the normal traction. a, b = radii, s = the distance from the middle in radii, 1 at
/// the rim; F = force:
///
///     sphere, ellipsoid  3 F / (2 pi a b) sqrt(1 - s^2)        (Hertz; Johnson 1985, 3.58)
///     punch              F / (2 pi a^2 sqrt(1 - s^2))          (Johnson 1985, 3.34)
///     cone               F / (pi a^2) arccosh(1 / s)           (Johnson 1985, 5.10)
///
/// The punch is infinite at its rim, the cone at its apex.
enum class SkinShape { sphere, ellipsoid, punch, cone };

/// "sphere" and so on.
[[nodiscard]] std::string_view name(SkinShape shape) noexcept;

/// A rigid body that presses, drags and twists.
///
/// Sliding drags by q = friction * p. In partial slip an inner disc or ellipse, `stick` times the
/// size of the contact, does not slide; its share of the drag is taken off (Cattaneo 1938, Mindlin
/// 1949; ellipses, cones: Jaeger 1998):
///
///     q = friction (p(radius a) - p(radius stick a, same curvature))
///
/// which leaves the drag friction F (1 - stick^3), of a cone friction F (1 - stick^2). A twist
/// adds a traction around the middle, c r sqrt(1 - s^2) at the distance r, whatever the shape:
/// of a circle c = 15 torsion / (4 pi a^4).
struct SkinContact {
  SkinShape shape = SkinShape::sphere;
  double y = 0.0;              ///< of the middle [m]
  double z = 0.0;              ///< of the middle [m]
  double radius = 1.0;         ///< a [m], > 0
  double second_radius = 0.0;  ///< b across a [m]: of an ellipsoid > 0, of others 0: b = a
  double angle = 0.0;          ///< of the radius a, from the y axis towards z [rad]
  double force = 1.0;          ///< F [N]
  double friction = 0.0;       ///< mu: tangential over normal force where it slides
  double direction = 0.0;      ///< of the drag, from the y axis towards z [rad]
  double stick = 0.0;          ///< [0, 1); 0: all of it slides; of a punch 0
  double torsion = 0.0;        ///< about x through the middle [N m], from y towards z
};

/// Tractions on a grid of rectangles, uniform over each.
struct SampledPatch {
  std::size_t rows = 0;                ///< along y, >= 1
  std::size_t columns = 0;             ///< along z, >= 1
  double y = 0.0;                      ///< y of the patch's middle [m]
  double z = 0.0;                      ///< z of the patch's middle [m]
  double spacing_y = 1.0;              ///< [m], > 0
  double spacing_z = 1.0;              ///< [m], > 0
  std::vector<double> normal{};        ///< [Pa], rows * columns, row after row
  std::vector<double> tangential_y{};  ///< [Pa], rows * columns; empty: 0
  std::vector<double> tangential_z{};  ///< [Pa], rows * columns; empty: 0
};

using SkinLoad = std::variant<SkinContact, SampledPatch>;

/// @throw std::invalid_argument  a value is out of its range or not finite
void check(const SkinLoad& load);

/// Traction [Pa] at (y, z) [m]; infinite, with the load's sign, where the profile is; 0 outside.
[[nodiscard]] double traction(const SkinLoad& load, Traction component, double y,
                              double z) noexcept;

/// Force and moments that tractions amount to.
struct SkinWrench {
  std::array<double, 3> force{};  ///< along x, y, z [N]
  double moment_y = 0.0;          ///< integral of y p [N m]
  double moment_z = 0.0;          ///< integral of z p [N m]
  double torque = 0.0;            ///< integral of y q_z - z q_y, about y = z = 0 [N m]

  struct Centre {
    double y = 0.0;
    double z = 0.0;
  };
  /// Centre of pressure [m]; absent if force[0] <= 0.
  [[nodiscard]] std::optional<Centre> centre() const noexcept {
    if (!(force[0] > 0.0)) return std::nullopt;
    return Centre{moment_y / force[0], moment_z / force[0]};
  }
  /// The moment about the surface's normal through the centre of pressure [N m]; absent without
  /// one.
  [[nodiscard]] std::optional<double> torsion() const noexcept {
    const auto at = centre();
    if (!at) return std::nullopt;
    return torque - at->y * force[2] + at->z * force[1];
  }
  SkinWrench& operator+=(const SkinWrench& other) noexcept;
};

/// Resultant of a load, or the sum over loads, in closed form.
[[nodiscard]] SkinWrench resultant(const SkinLoad& load) noexcept;
[[nodiscard]] SkinWrench resultant(std::span<const SkinLoad> loads) noexcept;

/// Resultant of the tractions of cells, taken to act at the cells' middles.
///
/// @param tractions  3 * grid.count() values, or grid.count(): normal ones alone
[[nodiscard]] SkinWrench resultant(std::span<const double> tractions,
                                   const SurfaceGrid& grid) noexcept;

/// The least rectangle along the axes that holds all of the load [m].
struct SkinSupport {
  double from_y = 0.0;
  double to_y = 0.0;
  double from_z = 0.0;
  double to_z = 0.0;
};
[[nodiscard]] SkinSupport support(const SkinLoad& load) noexcept;

/// True if the load has a traction along that axis anywhere.
[[nodiscard]] bool has_traction(const SkinLoad& load, Traction component) noexcept;

/// True if the load has a tangential traction anywhere: it drags or twists.
[[nodiscard]] bool drags(const SkinLoad& load) noexcept;

/// The mean of the loads' tractions over each cell [Pa], 3 * grid.count() values: integrals in
/// closed form, singular rims and apexes included, correct to some 1e-15 of the largest mean, and
/// times radius over spacing where that is more. So the cells' forces add up to the load's where
/// the grid holds all of it.
///
/// @throw std::invalid_argument  a load is out of range
[[nodiscard]] std::vector<double> cell_means(std::span<const SkinLoad> loads,
                                             const SurfaceGrid& grid);

}  // namespace tactile_net

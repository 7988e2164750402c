/// @file
/// What a traction on a curved skin causes: a layer bonded to a rigid ball, or to the wall of a
/// round hole.
///
/// Quantities and tractions are those of elasticity/quantity.hpp in frames that turn with the
/// surface: x points into the skin, against the outward normal, y and z lie along it. Places on a
/// sphere are seen from a load along the arc of the great circle: `ball_place`.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/elasticity/space/space_vector.hpp"

namespace tactile_net {

class BallTables;

/// The right-handed frame of a place on a surface: the unit vectors of x (into the skin), y and z,
/// one after the other, in the sensor's axes.
using SurfaceFrame = std::array<SpaceVector, 3>;

/// Where a taxel lies from a load, and how the load's frame is turned beside the taxel's.
struct BallPlace {
  double y = 0.0, z = 0.0;  ///< the arc from the load [m] times its direction in the taxel's frame
  double cosine = 1.0;  ///< of the angle from the taxel's y to the load's, brought along the arc
  double sine = 0.0;    ///< towards the taxel's z
};

/// The place of a taxel on a sphere. Only the two x of the frames tell where load and taxel are:
/// the taxel lies below the place of its frame. The load's y and z are brought along by the least
/// rotation that makes the one x the other.
///
/// @param radius  of the surface [m], > 0 on a ball, < 0 in a hole
///
/// Preconditions: unit vectors at right angles; the two x are not opposite, where no arc is the
/// shortest.
[[nodiscard]] BallPlace ball_place(const SurfaceFrame& load, const SurfaceFrame& taxel,
                                   double radius) noexcept;

/// The same of any two places whose surface is about as curved as a ball between them: the arc has
/// the direction of the chord, and the length that the chord has on the ball.
///
/// @param chord      from the load's place to the taxel's, both on the surface, in the sensor's
///                   axes [m]
/// @param curvature  of the ball [1/m]; 0 of a plane
[[nodiscard]] BallPlace surface_place(const SurfaceFrame& load, const SurfaceFrame& taxel,
                                      const SpaceVector& chord, double curvature) noexcept;

/// Readings at one depth of a bonded layer whose surface is a sphere, from unit point forces.
///
/// The series of spherical harmonics (Love 1927, article 172; docs/internals/space.md), exact at
/// every curvature: its limit at an infinite radius is `SkinKernel`, from which it differs by some
/// thickness / radius. It is summed into fifteen functions of the arc, interpolated, times an
/// angle. Beyond 48 thicknesses of arc readings are 0. A copy shares the tables.
///
/// Readings are within `error_bound` of the true ones. Lengths may be of any size.
class BallKernel {
 public:
  /// O(|radius| / depth), of at most 320 thicknesses of radius: some 10 ms at |radius| = 100 depth.
  ///
  /// @param material  with a bonded layer
  /// @param radius    of the outer surface [m]: > 0 on a ball, and more than the thickness; < 0
  ///                  where the skin lines a hole, which a base surrounds
  /// @param depth     below the surface [m], > 0, at most the thickness; at least 1 / 16000 of
  ///                  |radius|, or a fiftieth of the thickness where that is less
  ///
  /// @throw std::invalid_argument  a value is out of its range; the layer is missing, or slips on
  ///                               its base
  BallKernel(const Material& material, double radius, double depth);

  /// The reading from a unit point force [Pa/N for stress, 1/N for strain, m/N], the load's
  /// component along the taxel's own axes.
  ///
  /// @param y, z  the arc from the load times its direction in the taxel's frame [m], at most to
  ///              the antipode: pi |radius| long, else the reading is NaN
  [[nodiscard]] double operator()(Quantity quantity, Traction component, double y,
                                  double z) const noexcept;

  /// The same at many places; `y`, `z` and `readings` have one number each.
  void operator()(Quantity quantity, Traction component, std::span<const double> y,
                  std::span<const double> z, std::span<double> readings) const noexcept;

  /// The readings from unit point forces along x, y and z of the load's own frame.
  [[nodiscard]] std::array<double, 3> operator()(Quantity quantity,
                                                 const BallPlace& place) const noexcept;

  /// The largest error of a reading: 1e-12 of 3 / (2 pi depth^2) for stresses, of (1 + nu) / E
  /// times that for strains, of 3 (1 + nu) / (2 pi E depth) for displacements, which is about what
  /// a flat half space reads on the load's axis; times (radius / the core's radius)^2 on a ball,
  /// whose core gathers the load.
  [[nodiscard]] double error_bound(Quantity quantity) const noexcept;

  [[nodiscard]] double radius() const noexcept { return radius_; }

 private:
  template <std::size_t count>
  [[nodiscard]] std::array<double, count> read_at(Quantity quantity,
                                                  const std::array<Traction, count>& components,
                                                  double y, double z) const noexcept;

  Material material_;
  double radius_;
  double depth_;
  std::shared_ptr<const BallTables> tables_;
};

}  // namespace tactile_net

/// @file
/// The outer surface of a curved skin, laid on a flat chart.
///
/// Axes are the sensor's own, any right-handed ones [m]. A place has a frame of its own, as in
/// elasticity/quantity.hpp: x into the skin, against the outward normal; y as near as possible to a
/// reference direction of the sensor, there or in the chart's middle; z across both.
///
/// The chart is Lambert's: areas of a sphere are those of its picture. So tractions on a curved
/// skin are solved for on the same lattice of cells as those on a flat one.
///
///     const CurvedSurface ball({0, 0, 30e-3}, {0, 0, 1}, 1.0 / 30e-3, {0, 1, 0});
///     ball.at(2e-3, 0.0).point;               // two millimetres along y from the apex
///     ball.cells(grid)[0].force[0];           // what 1 Pa of pressure on it amounts to [N]
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/sensing/surface_cells.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// A rectangle of a chart [m].
struct ChartBox {
  double y_least = -std::numeric_limits<double>::infinity();
  double y_most = std::numeric_limits<double>::infinity();
  double z_least = -std::numeric_limits<double>::infinity();
  double z_most = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool holds(double y, double z) const noexcept {
    return y >= y_least && y <= y_most && z >= z_least && z <= z_most;
  }
};

/// A polynomial of two variables: the terms of degree 0, then those of degree 1, and so on, in each
/// degree by rising powers of z. Beyond an ellipse it goes on straight along every ray from its
/// middle, where a polynomial of what lies inside would turn up or down steeply.
struct HeightField {
  std::size_t degree = 0;
  double length = 1.0;  ///< what y and z are divided by [m], > 0
  /// (degree + 1) (degree + 2) / 2 coefficients [m]; empty: 0 everywhere.
  std::vector<double> coefficients{};
  double end_y = std::numeric_limits<double>::infinity();  ///< half axis of the ellipse [m], > 0
  double end_z = std::numeric_limits<double>::infinity();
  /// Where it is known; it is asked for nowhere else.
  ChartBox known{};

  struct Value {
    double height = 0.0;   ///< [m]
    double slope_y = 0.0;  ///< d height / d y
    double slope_z = 0.0;  ///< d height / d z
  };
  [[nodiscard]] Value at(double y, double z) const;
  /// What each coefficient is multiplied by.
  [[nodiscard]] std::vector<Value> terms(double y, double z) const;
};

/// How the y of a place's frame follows from the reference direction.
enum class SurfaceFrames { tangent, carried };

template <>
struct Enumerators<SurfaceFrames> {
  static constexpr Enumerator<SurfaceFrames> all[] = {
      {SurfaceFrames::tangent, "tangent", "The reference made tangent at each place."},
      {SurfaceFrames::carried, "carried",
       "The reference made tangent in the middle of the taxels, and turned with the normal."}};
};

/// A sphere or a plane, and a polynomial height above it.
class CurvedSurface {
 public:
  /// @param apex       of the chart, which is y = z = 0 there [m]
  /// @param outward    the outward normal there, a unit vector
  /// @param curvature  of the sphere [1/m]: > 0 of a ball, < 0 of a hole, 0 of a plane
  /// @param reference  what the frames' y is as near as possible to; not 0
  /// @param frames     carried: by the least rotation from the apex's normal to that of a place
  ///
  /// @throw std::invalid_argument  a number is not finite, outward is no unit vector, or the
  ///                               reference is within 10 degrees of the normal
  CurvedSurface(const SpaceVector& apex, const SpaceVector& outward, double curvature,
                const SpaceVector& reference, SurfaceFrames frames = SurfaceFrames::tangent);

  /// The surface at this height above the sphere, along its outward normal.
  [[nodiscard]] CurvedSurface raised(HeightField height) const;
  /// A sphere through the same apex, with the same frames there.
  [[nodiscard]] CurvedSurface bent(double curvature) const;

  /// The place at (y, z) of the chart [m].
  /// @throw std::invalid_argument  it lies beyond the chart's end, `most_angle` from the apex, or
  ///                               where the height is not known; or the reference is within 10
  ///                               degrees of its normal
  [[nodiscard]] SurfacePlace at(double y, double z) const;

  /// A place, and how it moves with y and z of the chart.
  struct Tangents {
    SpaceVector point{};
    SpaceVector along_y{};
    SpaceVector along_z{};
  };
  /// @throw std::invalid_argument  it lies beyond the chart's end
  [[nodiscard]] Tangents tangents(double y, double z) const;

  /// Where a point is on the chart, that normal of the sphere on which it lies, and how far it is
  /// outside of the surface along it [m].
  struct Charted {
    double y = 0.0;
    double z = 0.0;
    double outside = 0.0;
  };
  [[nodiscard]] Charted chart(const SpaceVector& point) const;

  /// The frame of a place with this outward normal.
  /// @throw std::invalid_argument  the reference is within 10 degrees of it; of carried frames, it
  ///                               is within 10 degrees of the opposite of the apex's
  [[nodiscard]] SurfaceFrame frame(const SpaceVector& outward) const;

  /// The cells of a grid of the chart, row after row. Integrals by nine points each.
  /// @throw std::invalid_argument  as `at`
  [[nodiscard]] std::vector<SurfaceCell> cells(const SurfaceGrid& grid) const;

  [[nodiscard]] double curvature() const noexcept { return curvature_; }
  [[nodiscard]] const HeightField& height() const noexcept { return height_; }

  /// The chart ends so far from its apex [rad].
  static constexpr double most_angle = 2.6;

 private:
  SpaceVector apex_;
  double curvature_;
  SpaceVector reference_;
  SurfaceFrames frames_;
  HeightField height_;
  SurfaceFrame axes_{};  // of the apex
};

}  // namespace tactile_net

/// @file
/// What a curved surface is in the sensor's own axes: places with their frames, and cells that
/// tractions are solved for.
///
/// The axes are any right-handed ones [m]. Each place has a frame of its own, as in
/// elasticity/quantity.hpp: x into the material, against the outward normal.
#pragma once

#include <array>

#include "tactile_net/elasticity/space/ball_kernel.hpp"
#include "tactile_net/elasticity/space/space_vector.hpp"

namespace tactile_net {

/// A place on a surface.
struct SurfacePlace {
  SpaceVector point{};                ///< [m]
  SurfaceFrame frame{};               ///< x against the outward normal
  double stretch = 1.0;               ///< the surface's area over that of its chart
  double mean_curvature = 0.0;        ///< [1/m]; > 0 where the surface is that of a ball
  double curvature_difference = 0.0;  ///< of the largest and the least curvature there [1/m], >= 0
};

/// A cell, with what tractions that are 1 Pa all over it amount to. Tractions turn with the frames
/// of its places.
struct SurfaceCell {
  SurfacePlace middle{};
  double area = 0.0;                    ///< [m^2]
  SpaceVector first_moment{};           ///< the integral of its places [m^3]
  std::array<SpaceVector, 3> force{};   ///< of 1 Pa along x, y and z of its frames [N]
  std::array<SpaceVector, 3> moment{};  ///< the same about the sensor's origin [N m]
};

}  // namespace tactile_net

/// @file
/// From the contact points of a rigid-body simulator to patches of load in plane strain; to loads
/// on a skin go skin_contacts.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/patch_kernel.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// Where a rigid object touches the pad; `along` is y of the array, 0 its middle.
struct ContactPoint {
  std::size_t object = 0;   ///< points of one object make one patch
  double curvature = 0.0;   ///< of the object against the pad [1/m]; 0: flat, or unknown
  double along = 0.0;       ///< [m]
  double across = 0.0;      ///< [m]
  double normal = 0.0;      ///< into the pad [N]; a point that does not press is left out
  double tangential = 0.0;  ///< along y [N]
  double sideways = 0.0;    ///< across [N]; in plane strain nothing follows it
};

/// A contact of two objects in the world, as MuJoCo has it.
struct PairContact {
  std::array<double, 3> position{};
  std::array<double, 9> frame{};  ///< row-major; its first row points from the first to the second
  std::array<double, 3> force{};  ///< on the second, in that frame [N]
};

/// A pad's flat face in the world.
struct PadFace {
  std::array<double, 3> origin{};  ///< below which the array's middle lies
  /// Row-major; its columns are x along the array, y across it, z out of the pad.
  std::array<double, 9> axes{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

  struct Touch {
    double facing = 0.0;   ///< cosine between the direction in which the contact presses and -z
    ContactPoint point{};  ///< `object` and `curvature` are the caller's
  };
  [[nodiscard]] Touch touched_by(const PairContact& contact, bool pad_is_second) const noexcept;
};

/// Below it a contact is beside the face, below its negative behind it.
inline constexpr double least_facing = 0.7;

struct ContactWidths {
  double breadth = 1.0;  ///< of the pad, across the array: forces are spread over it [m], > 0
  double edge = 1.0;     ///< least width of a contact whose curvature nobody knows [m], > 0
};

/// @param edge  absent: half the least depth of the scene's taxels, whose readings a narrower
///              contact hardly changes
/// @throw std::invalid_argument  one is not finite and > 0
[[nodiscard]] ContactWidths contact_widths(const Scene& scene, double breadth,
                                           std::optional<double> edge = {});

struct ContactPatches {
  std::vector<LoadPatch> loads{};
  /// Extent across the array of the object for which that is least [m]; absent: nothing presses.
  /// Plane strain holds for contacts that are long against the taxels' depth.
  std::optional<double> shortest{};
};

/// One patch for each object that presses.
///
/// Of curvature 1/R and under the force F per breadth it is Hertz' strip, of half width
/// sqrt(4 F R (1 - nu^2) / (pi E)), unless its points reach farther. Otherwise it is the linear
/// traction over all its points that has their force and moment; where they lie so near one end
/// that it would pull at the other, over the part that it presses.
///
/// @param pad     its layer is not looked at: the width is that on a half plane
/// @param points  those of one object need not be side by side
/// @throw std::invalid_argument  the material is out of range
[[nodiscard]] ContactPatches contact_patches(std::span<const ContactPoint> points,
                                             const Material& pad, const ContactWidths& widths);

}  // namespace tactile_net::lab

/// @file
/// From the contact points of a rigid-body simulator to loads on a skin.
///
///     const std::vector<SkinLoad> loads = skin_loads(points, silicone, 1e-3);
///     model.readings(loads);                        // ExactSkinModel, skin/forward.hpp
#pragma once

#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/lab/rigid_contacts.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net::lab {

/// One load for each object that presses; `along` and `sideways`' axis are the skin's y and minus
/// z: seen from outside y runs to the right, and the simulator's other axis upwards.
///
/// A single point of curvature 1/R under the force F is Hertz' circle, of radius
/// (3 F R (1 - nu^2) / (4 E))^(1/3) as on a half space, and drags by what it presses. All else, a
/// box, a mesh, points farther apart than that circle, is the traction over the points' convex hull
/// that is linear where it presses and has their force and moments, without pulling anywhere; its
/// drag has their drag and torque, each spread as the pressure is. A hull narrower than `edge` is
/// made as wide.
///
/// @param points  those of one object need not be side by side
/// @param edge    least width of a contact whose curvature nobody knows [m], > 0
/// @throw std::invalid_argument  the material or `edge` is out of range
[[nodiscard]] std::vector<SkinLoad> skin_loads(std::span<const ContactPoint> points,
                                               const Material& pad, double edge);

}  // namespace tactile_net::lab

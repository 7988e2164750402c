/// @file
/// From the contact points of a rigid-body simulator to tractions on a skin.
///
///     const SkinPadModel model(scene);              // simulated_skin_pad.hpp: has the cells
///     const auto patches = skin_patches(points, scene.material, 1e-3, model.grid());
///     resultant(patches.front()).force;             // the object's force, exactly
#pragma once

#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/lab/rigid_contacts.hpp"
#include "tactile_net/skin/grid.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net::lab {

/// Cells that one object may press on, at most.
inline constexpr std::size_t most_touched_cells = std::size_t{1} << 18;

/// One patch for each object that presses, on cells of the grid and of what continues it beyond its
/// ends. `along` is the skin's y, `across` and `sideways` are along minus z: seen from outside y
/// runs to the right, and the simulator's other axis upwards.
///
/// A single point of curvature 1/R under the force F is Hertz' circle, of radius
/// (3 F R (1 - nu^2) / (4 E))^(1/3) as on a half space. All else, a box, a mesh, points farther
/// apart than that circle, is the traction over the points' convex hull that is linear where it
/// presses, and pulls nowhere. A hull narrower than `edge` is made as wide; of points of one
/// curvature, as of a lying cylinder, as Hertz' strip is. Where the force acts nearer to the
/// hull's rim than such a traction reaches it is a point load, on three by three cells.
///
/// Each patch has its points' force and moments, whatever the cells; its drag has their drag and
/// torque, spread as the pressure is.
///
/// @param points  those of one object need not be side by side
/// @param edge    least width of a contact whose curvature nobody knows [m], > 0
/// @throw std::invalid_argument  the material or `edge` is out of range, or an object presses on
///                               more than `most_touched_cells`
[[nodiscard]] std::vector<SampledPatch> skin_patches(std::span<const ContactPoint> points,
                                                     const Material& pad, double edge,
                                                     const SurfaceGrid& grid);

}  // namespace tactile_net::lab

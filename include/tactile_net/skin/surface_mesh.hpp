/// @file
/// A surface as triangles: of a file (.obj, .stl), or of another program.
///
///     SurfaceMesh mesh{.vertices = {...}, .triangles = {{0, 1, 2}, ...}};
///     check(mesh);
///     const SkinArray skin = curved_skin(taxels, {.shape = SurfaceShape::mesh,
///         .mesh = std::make_shared<const SurfaceMesh>(std::move(mesh))});
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tactile_net/elasticity/space/space_vector.hpp"

namespace tactile_net {

struct SurfaceMesh {
  std::vector<SpaceVector> vertices{};  ///< in the sensor's axes [m]
  /// Indices of vertices, counterclockwise seen from outside. Messages count them from 1.
  std::vector<std::array<std::size_t, 3>> triangles{};
};

/// So many of 30 um cover a square of 2 cm.
inline constexpr std::size_t most_triangles = std::size_t{1} << 20;

/// @throw std::invalid_argument  there is no triangle, or more than `most_triangles`; a vertex is
///                               not finite; a triangle names none, has no area, or shares an edge
///                               with two others or with one that is turned the other way; the
///                               extent is above 1 m or below 1 mm, as of other units
void check(const SurfaceMesh& mesh);

}  // namespace tactile_net

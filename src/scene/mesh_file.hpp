/// @file
/// Meshes of other programs: Wavefront .obj, and .stl as text or binary. Private.
#pragma once

#include <filesystem>

#include "tactile_net/scene/units.hpp"
#include "tactile_net/skin/surface_mesh.hpp"

namespace tactile_net {

/// Polygons of an .obj are cut into triangles; corners of an .stl that are at one place are one
/// vertex. Normals, textures and materials are left out. Nothing is allotted by what a file
/// announces: only by what it holds.
///
/// @param unit  of its lengths
/// @throw std::runtime_error     it cannot be read, has another ending, is larger than 128 MiB, or
///                               what is wrong, with the line or the triangle
/// @throw std::invalid_argument  as `check`
[[nodiscard]] SurfaceMesh read_mesh_file(const std::filesystem::path& path, const Unit& unit);

}  // namespace tactile_net

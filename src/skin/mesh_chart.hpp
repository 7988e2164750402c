/// @file
/// A mesh of triangles as heights over the chart of a sphere. Private.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {

/// The outward normals of a mesh at its triangles' corners: the mean of the triangles there without
/// those beyond a crease, by weights that are exact for vertices on a sphere, however irregular
/// (Max, Weights for computing vertex normals from facet normals, 1999). Between its corners a
/// triangle is bent as they say.
class MeshNormals {
 public:
  /// @param mesh  kept by reference, in order
  explicit MeshNormals(const SurfaceMesh& mesh);

  [[nodiscard]] const SpaceVector& of_face(std::size_t triangle) const { return faces_[triangle]; }
  [[nodiscard]] std::array<SpaceVector, 3> at_corners(std::size_t triangle) const;
  /// Where the mesh is the nearest to a point.
  [[nodiscard]] SpaceVector nearest_to(const SpaceVector& point) const;

 private:
  const SurfaceMesh& mesh_;
  std::vector<SpaceVector> faces_{};
  std::vector<std::size_t> first_{};  // of each vertex in at_
  std::vector<std::size_t> at_{};     // triangles
};

/// A taxel as a mesh sees it.
struct BelowMesh {
  std::string name{};
  SpaceVector above{};   ///< the place of the surface above it, by its depth and normal [m]
  SpaceVector normal{};  ///< outward, a unit vector
  double depth = 0.0;    ///< [m]
};

/// The smooth surface through the part of a mesh that lies around taxels: a polynomial of the
/// chart, of the least degree that follows the mesh within a thousandth of the least depth, or else
/// of the highest.
struct MeshHeight {
  HeightField height{};
  double residual = 0.0;  ///< of the mesh about it, rms [m]
};

/// @param normals  of the mesh
/// @param sphere   without a height, the chart's middle above the middle of the taxels
/// @throw std::invalid_argument  as `curved_skin`
[[nodiscard]] MeshHeight mesh_height(const SurfaceMesh& mesh, const MeshNormals& normals,
                                     const CurvedSurface& sphere,
                                     std::span<const BelowMesh> taxels);

}  // namespace tactile_net

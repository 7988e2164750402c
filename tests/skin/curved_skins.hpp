/// @file
/// Taxels below curved surfaces.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {

inline const std::vector<Quantity> moves = {Quantity::displacement_x, Quantity::displacement_y,
                                            Quantity::displacement_z};
inline const Material skin_on_core{
    .youngs_modulus = 2.5e5, .poisson_ratio = 0.48, .layer = Layer{4e-3, Base::bonded}};

/// Taxels below an ellipsoid of these half axes, or a sphere; z out at the apex.
inline std::vector<CurvedTaxel> taxels_below(const SpaceVector& half_axes, double reach, int count,
                                             double depth, const std::vector<Quantity>& reads) {
  std::vector<CurvedTaxel> taxels;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const double x = reach * (2.0 * i / (count - 1.0) - 1.0);
      const double y = reach * (2.0 * j / (count - 1.0) - 1.0);
      const SpaceVector at = {x, y,
                              half_axes[2] * std::sqrt(1.0 - std::pow(x / half_axes[0], 2) -
                                                       std::pow(y / half_axes[1], 2))};
      SpaceVector normal = {at[0] / std::pow(half_axes[0], 2), at[1] / std::pow(half_axes[1], 2),
                            at[2] / std::pow(half_axes[2], 2)};
      normal = multiple(1.0 / length(normal), normal);
      taxels.push_back({"t" + std::to_string(i) + "_" + std::to_string(j),
                        combined(1.0, at, -depth, normal), normal, depth, reads});
    }
  return taxels;
}

inline std::vector<CurvedTaxel> ball_taxels(double radius, int count = 5) {
  return taxels_below({radius, radius, radius}, 5e-3, count, 1.2e-3, moves);
}

/// A lattice over the square of half width `reach`, from below z = height(x, y) counterclockwise
/// seen from above, two triangles a cell; inner vertices are moved by up to `jitter` of a cell.
inline SurfaceMesh mesh_over(double reach, int cells, double jitter,
                             const std::function<double(double, double)>& height) {
  SurfaceMesh mesh;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> moved(-jitter, jitter);
  const double step = 2.0 * reach / cells;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      const double x = -reach + step * (i + (inner ? moved(random) : 0.0));
      const double y = -reach + step * (j + (inner ? moved(random) : 0.0));
      mesh.vertices.push_back({x, y, height(x, y)});
    }
  const auto row = static_cast<std::size_t>(cells) + 1;
  for (std::size_t i = 0; i + 1 < row; ++i)
    for (std::size_t j = 0; j + 1 < row; ++j) {
      const std::size_t at = i * row + j;
      mesh.triangles.push_back({at, at + row, at + row + 1});
      mesh.triangles.push_back({at, at + row + 1, at + 1});
    }
  return mesh;
}

/// Of an ellipsoid around the origin, the side of z > 0.
inline SurfaceMesh ellipsoid_mesh(const SpaceVector& half_axes, double reach, int cells,
                                  double jitter = 0.25) {
  return mesh_over(reach, cells, jitter, [=](double x, double y) {
    return half_axes[2] *
           std::sqrt(1.0 - std::pow(x / half_axes[0], 2) - std::pow(y / half_axes[1], 2));
  });
}

inline CurvedSkinOptions on_mesh(SurfaceMesh mesh) {
  return {.shape = SurfaceShape::mesh,
          .mesh = std::make_shared<const SurfaceMesh>(std::move(mesh)),
          .axes = ReadingAxes::sensor};
}

}  // namespace tactile_net

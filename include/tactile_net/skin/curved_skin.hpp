/// @file
/// A skin whose surface is curved: taxels below a ball, in a hole, or below any smooth surface.
///
/// It is an irregular skin (array.hpp) whose y and z are places on its surface's chart
/// (curved_surface.hpp), and which knows that surface. So all that is done with irregular skins is
/// done with it, and forces are also told in the sensor's own axes (space_wrench.hpp).
///
///     std::vector<CurvedTaxel> taxels = {{"tip", {0, 0, 28.8e-3}, SpaceVector{0, 0, 1}, 1.2e-3,
///                                         {Quantity::displacement_x, ...}}, ...};
///     const SkinArray skin = curved_skin(taxels, {.axes = ReadingAxes::sensor});
///     const LinearProblem problem = make_problem(skin, silicone);   // skin/problem.hpp
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/curved_surface.hpp"
#include "tactile_net/skin/surface_mesh.hpp"

namespace tactile_net {

/// A place in a curved pad where something is read.
struct CurvedTaxel {
  std::string name{};                   ///< empty: its index
  SpaceVector place{};                  ///< where it reads, in the sensor's axes [m]
  std::optional<SpaceVector> normal{};  ///< outward, of the surface above it, a unit vector
  double depth = 0.0;                   ///< below the surface along the normal [m], > 0
  std::vector<Quantity> reads{};        ///< at least one, none twice
};

/// What a curved skin's surface is.
enum class SurfaceShape { sphere, points, mesh };

template <>
struct Enumerators<SurfaceShape> {
  static constexpr Enumerator<SurfaceShape> all[] = {
      {SurfaceShape::sphere, "sphere", "A ball, or a round hole."},
      {SurfaceShape::points, "points",
       "A smooth surface through the places above the taxels, of any curvature."},
      {SurfaceShape::mesh, "mesh", "A smooth surface through a mesh of triangles."}};
};

/// Along which axes displacements are read; other quantities are always the surface's own.
enum class ReadingAxes { local, sensor };

template <>
struct Enumerators<ReadingAxes> {
  static constexpr Enumerator<ReadingAxes> all[] = {
      {ReadingAxes::local, "local", "Of each taxel: x into the skin, y and z along it."},
      {ReadingAxes::sensor, "sensor", "The sensor's own."}};
};

/// What a traction on a curved skin is taken to cause.
enum class CurvedKernel { ball, flat };

template <>
struct Enumerators<CurvedKernel> {
  static constexpr Enumerator<CurvedKernel> all[] = {
      {CurvedKernel::ball, "ball",
       "A layer on a ball that is as curved as the surface above each taxel."},
      {CurvedKernel::flat, "flat", "A flat layer, laid along the surface."}};
};

struct CurvedSkinOptions {
  /// Absent: the sphere where the taxels lie below one, else the surface through their places.
  std::optional<SurfaceShape> shape{};
  std::optional<SpaceVector> centre{};  ///< of the sphere [m]; absent: it is fitted
  /// Of the sphere's outer surface [m], < 0: of a hole; absent: it is fitted.
  std::optional<double> radius{};
  /// Of the shape mesh, which needs it: the outer surface, around the taxels at least.
  std::shared_ptr<const SurfaceMesh> mesh{};
  SpaceVector reference = {0.0, 1.0, 0.0};  ///< that every frame's y is as near as possible to
  SurfaceFrames frames = SurfaceFrames::tangent;
  ReadingAxes axes = ReadingAxes::local;
  CurvedKernel kernel = CurvedKernel::ball;
};

/// What tractions on cells of a curved skin cause, by whatever computation: of a pad whose layer is
/// no ball's.
///
/// Cells that lie in rows and columns are the answer's own. Of others, such as triangles, the
/// answer has the chart's cells, and each bears the mean of what these bear over it.
struct GivenKernel {
  std::string from{};                ///< the name of its file
  std::size_t rows = 0;              ///< of cells, >= 2; 0: they lie in no rows and columns
  std::size_t columns = 0;           ///< of cells, >= 2; 0 as rows
  std::vector<SurfaceCell> cells{};  ///< row after row
  /// Of cells in no rows and columns: counterclockwise from outside; a triangle has the last twice.
  std::vector<std::array<SpaceVector, 4>> corners{};
  /// Readings in the skin's order x (3 cells, all normal tractions first) [unit of a reading / Pa].
  Matrix kernel{};
};

/// A cell between four corners, or three of which the last stands there twice, with the frame at
/// its middle.
/// @param corners  counterclockwise from outside [m]
[[nodiscard]] SurfaceCell quadrilateral(const std::array<SpaceVector, 4>& corners,
                                        const SurfaceFrame& frame);

/// What is known of a curved skin beside its taxels on the chart.
struct CurvedSkin {
  CurvedSurface surface;
  SurfaceShape shape = SurfaceShape::sphere;
  ReadingAxes axes = ReadingAxes::local;
  CurvedKernel kernel = CurvedKernel::ball;
  std::vector<SurfacePlace> above{};  ///< the place of the surface above each taxel
  /// Of these places, or of the mesh, about the surface that was fitted, rms [m].
  double residual = 0.0;
  /// In place of `kernel`; null: that says it.
  std::shared_ptr<const GivenKernel> given{};
};

/// A curved skin.
///
/// @param taxels  one at least; with normals, or else below a sphere or a mesh
/// @throw std::invalid_argument  as `check`; a normal is missing, no unit vector within 1e-3 or
///                               points into the pad; a centre or a radius without a sphere; a
///                               sphere that the taxels do not lie below, or whose radius they do
///                               not tell; a mesh that is not in order, open or turned inside out
///                               above a taxel, lying over itself, too rough, or at another depth
///                               than a taxel says; the reference is within 10 degrees of a normal;
///                               an extent above 1 m or below 1 mm, as of other units
[[nodiscard]] SkinArray curved_skin(std::vector<CurvedTaxel> taxels,
                                    const CurvedSkinOptions& options = {});

/// The same surface, its taxels deeper below it, along their normals, by a factor.
/// @param factor  > 0
/// @throw std::invalid_argument  the skin is not curved
[[nodiscard]] SkinArray with_depth_factor(const SkinArray& skin, double factor);

/// The same skin with that kernel: where its cells lie in rows and columns the skin's chart is then
/// their lattice, rows along the frames' y.
///
/// @param skin  curved
/// @throw std::invalid_argument  a size does not fit; a number is not finite, or the kernel is 0; a
///                               cell is turned inside out, or none lies above a taxel
[[nodiscard]] SkinArray with_kernel(const SkinArray& skin, GivenKernel kernel);
[[nodiscard]] SkinArray with_kernel(SkinArray skin, CurvedKernel kernel);

/// The cells that tractions of a curved skin are solved for: a given kernel's, or the surface's.
/// @param grid  of the skin's chart
/// @throw std::invalid_argument  a cell lies beyond the chart, or beyond a given kernel's cells
[[nodiscard]] std::vector<SurfaceCell> cells_of(const SkinArray& skin, const SurfaceGrid& grid);

}  // namespace tactile_net

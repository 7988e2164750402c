/// @file
/// The kernel of a curved skin's problem. Private.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/sensing/surface_cells.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/load.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// What a curved skin asks of its material.
/// @throw std::invalid_argument  it is no bonded layer, or thicker than its surface's radius
void check_curved(const SkinArray& skin, const Material& material);

/// The curvature of the ball whose kernel a taxel takes: that of a sphere, and of surfaces that
/// bend differently the mean of a group of taxels, so that few kernels are made.
class KernelCurvatures {
 public:
  KernelCurvatures(const CurvedSkin& skin, double thickness);
  /// @param curvature  of the surface above a taxel [1/m]
  [[nodiscard]] double taken(double curvature) const;

 private:
  bool is_flat_;
  std::map<double, double> groups_{};  // from the least of each group to its mean
};

/// The axes along which a taxel reads a quantity: x, y and z of the quantity's kind, each with its
/// share of the reading.
struct AxisShares {
  std::array<Quantity, 3> quantities{};
  std::array<double, 3> shares{};
  std::size_t count = 0;
};
[[nodiscard]] AxisShares axis_shares(Quantity quantity, const SurfaceFrame& taxel,
                                     ReadingAxes axes);

/// Whose middle is the nearest. @pre  there is a cell
[[nodiscard]] std::size_t nearest_cell(std::span<const SurfaceCell> cells,
                                       const SpaceVector& point);

/// Whether a kernel is given whose cells, in rows and columns, are the answer's.
[[nodiscard]] bool has_own_cells(const SkinArray& skin) noexcept;

/// The grid of the chart of such a skin.
[[nodiscard]] SurfaceGrid given_grid(const SkinArray& skin);

/// What tractions on a curved skin cause: the tables of every taxel, made once. Threads may share
/// it.
class CurvedReadings {
 public:
  /// @throw std::invalid_argument  as `check_curved`
  CurvedReadings(const SkinArray& skin, const Material& material);
  ~CurvedReadings();
  CurvedReadings(const CurvedReadings&) = delete;
  CurvedReadings& operator=(const CurvedReadings&) = delete;

  /// Fills in W K and its error.
  /// @pre  the problem's sites, weights, components and grid are this skin's
  void add_kernel(LinearProblem& problem) const;

  /// K of a grid of the chart, readings x (components x cells).
  [[nodiscard]] Matrix kernel(const SurfaceGrid& grid, std::size_t components) const;

  /// Readings under loads that lie on the chart, where their forces are exact: by cells of a grid
  /// and of one half as fine, which together leave the fourth power of its spacing. Of a kernel
  /// that is given, by its cells.
  /// @throw std::invalid_argument  a load is out of range, or beyond the chart
  [[nodiscard]] std::vector<double> readings(std::span<const SkinLoad> loads) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace tactile_net

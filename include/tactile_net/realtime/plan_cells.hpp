/// @file
/// The cells of a surface, by what a controller tells those that touch from empty ones, and what
/// they amount to in space.
#pragma once

#include <cstddef>
#include <vector>

namespace tactile_net {

/// The cells of a skin's surface; each traction is row after row of them.
struct PlanCells {
  std::size_t rows = 0;     ///< along y
  std::size_t columns = 0;  ///< along z
  double spacing_y = 0.0;   ///< [m], > 0
  double spacing_z = 0.0;   ///< [m], > 0
  double centre_y = 0.0;    ///< y of the grid's middle [m]
  double centre_z = 0.0;    ///< z of the grid's middle [m]
  /// Standard deviation of each cell's normal traction [Pa]. It tells cells that touch, the only
  /// ones to be summed, from empty ones. Empty: not known; all cells are summed.
  std::vector<double> deviations{};
  std::size_t rim_rows = 0;     ///< rows by which a contact's cells are widened to either side
  std::size_t rim_columns = 0;  ///< columns by which they are widened
  /// Standard deviation of the sum of normal tractions over the window around each cell [Pa]. It
  /// finds contacts of which no single cell is certain. Empty: single cells decide.
  std::vector<double> window_deviations{};
  std::size_t window_rows = 0;     ///< rows that a window reaches to either side, < rows
  std::size_t window_columns = 0;  ///< columns that it reaches, < columns

  [[nodiscard]] double area() const noexcept { return spacing_y * spacing_z; }
};

/// What the tractions of a curved skin's cells amount to in the sensor's own axes.
struct PlanSpace {
  /// Force along x, y and z [N] and moment about x, y and z through a point that the plan's maker
  /// chose [N m], of 1 Pa: six rows of a number for each traction.
  std::vector<double> wrench{};
  /// The mean place of each cell [m]: x of all, then y, then z.
  std::vector<double> places{};
};

}  // namespace tactile_net

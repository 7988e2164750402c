#include "realtime/skin_resultant.hpp"

#include <algorithm>
#include <cmath>

#include "realtime/touching_cells.hpp"

namespace tactile_net {
namespace {

/// Calls `visit(cell, y, z)` for marked cells, or all; places from the middle of the grid, in
/// spacings.
void for_each_cell(const PlanCells& cells, const std::uint8_t* marks, const auto& visit) noexcept {
  const double middle_y = 0.5 * static_cast<double>(cells.rows - 1);
  const double middle_z = 0.5 * static_cast<double>(cells.columns - 1);
  std::size_t cell = 0;
  for (std::size_t row = 0; row < cells.rows; ++row)
    for (std::size_t column = 0; column < cells.columns; ++column, ++cell)
      if (marks == nullptr || marks[cell] != 0)
        visit(cell, (static_cast<double>(row) - middle_y) * cells.spacing_y,
              (static_cast<double>(column) - middle_z) * cells.spacing_z);
}

/// Sums of tractions, times an area forces and moments.
struct Sums {
  double p = 0.0, q_y = 0.0, q_z = 0.0;
  double y_p = 0.0, z_p = 0.0;
  double torque = 0.0;
};

Sums sums_of(const PlanCells& cells, std::size_t unknowns, const double* f,
             const std::uint8_t* marks) noexcept {
  Sums sums;
  const double* const q_y = f + cells.rows * cells.columns;
  const double* const q_z = q_y + cells.rows * cells.columns;
  for_each_cell(cells, marks, [&](std::size_t cell, double y, double z) {
    sums.p += f[cell];
    sums.y_p += y * f[cell];
    sums.z_p += z * f[cell];
    if (unknowns == 1) return;
    sums.q_y += q_y[cell];
    sums.q_z += q_z[cell];
    sums.torque += y * q_z[cell] - z * q_y[cell];
  });
  return sums;
}

}  // namespace

void add_skin_resultant(const PlanCells& cells, std::size_t unknowns, const double* f,
                        std::optional<double> friction, double certain_force, double highest,
                        double lowest, CellMarks& scratch, ContactEstimate& estimate) noexcept {
  const double area = cells.area();
  const std::size_t count = cells.rows * cells.columns;
  double all = 0.0;
  for (std::size_t i = 0; i < count; ++i) all += f[i];
  all *= area;
  const TouchedWindows windows{cells.window_rows, cells.window_columns,
                               cells.window_deviations.data(), scratch.sums.data(),
                               scratch.along.data()};
  estimate.touching =
      cells.deviations.empty()
          ? 0
          : mark_touching({cells.rows, cells.columns, cells.rim_rows, cells.rim_columns}, f,
                          cells.deviations.data(),
                          cells.window_deviations.empty() ? nullptr : &windows,
                          scratch.marks.data(), scratch.queue.data(), [](std::size_t) {});
  const std::uint8_t* const marks = estimate.touching > 0 ? scratch.marks.data() : nullptr;
  const Sums sums = sums_of(cells, unknowns, f, marks);

  estimate.normal_force = area * sums.p;
  estimate.contact = estimate.normal_force > 0.0 && (marks != nullptr || all > certain_force);
  estimate.pulls = all < lowest;
  estimate.implausible = std::abs(all) > highest;
  if (unknowns > 1) {
    estimate.tangential_y = area * sums.q_y;
    estimate.tangential_z = area * sums.q_z;
    estimate.tangential_force = std::hypot(estimate.tangential_y, estimate.tangential_z);
    if (friction)
      estimate.friction_margin = *friction * estimate.normal_force - estimate.tangential_force;
  }
  if (!estimate.contact) return;
  const double y = sums.y_p / sums.p;
  const double z = sums.z_p / sums.p;
  estimate.centre = cells.centre_y + y;
  estimate.centre_z = cells.centre_z + z;
  if (unknowns == 1) return;
  estimate.angle = std::atan2(estimate.tangential_force, estimate.normal_force);
  estimate.torsion = area * (sums.torque - y * sums.q_z + z * sums.q_y);
  const double hold = friction ? *friction * estimate.normal_force : 0.0;
  if (!(hold > 0.0)) return;
  double lever = 0.0;
  for_each_cell(cells, marks, [&](std::size_t cell, double at_y, double at_z) {
    const double from_y = at_y - y;
    const double from_z = at_z - z;
    lever += std::max(f[cell], 0.0) * std::sqrt(from_y * from_y + from_z * from_z);
  });
  const double turn = *friction * area * lever;
  const double slide = estimate.tangential_force / hold;
  const double twist = turn > 0.0 ? estimate.torsion / turn : 0.0;
  estimate.slip_margin = 1.0 - std::hypot(slide, twist);
}

}  // namespace tactile_net

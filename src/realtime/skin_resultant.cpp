#include "realtime/skin_resultant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// Sums of marked cells, or all; `sums_of(cell)` is where a cell's go.
void add_cells(const PlanCells& cells, std::size_t unknowns, const double* f,
               const std::uint8_t* marks, const auto& sums_of) noexcept {
  const double* const q_y = f + cells.rows * cells.columns;
  const double* const q_z = q_y + cells.rows * cells.columns;
  for_each_cell(cells, marks, [&](std::size_t cell, double y, double z) {
    CellSums& sums = sums_of(cell);
    sums.p += f[cell];
    sums.y_p += y * f[cell];
    sums.z_p += z * f[cell];
    if (unknowns == 1) return;
    sums.q_y += q_y[cell];
    sums.q_z += q_z[cell];
    sums.torque += y * q_z[cell] - z * q_y[cell];
  });
}

/// After the sums. @pre  p > 0 of those that are asked for
void add_levers(const PlanCells& cells, const double* f, const std::uint8_t* marks,
                const auto& sums_of) noexcept {
  for_each_cell(cells, marks, [&](std::size_t cell, double y, double z) {
    CellSums& sums = sums_of(cell);
    const double from_y = y - sums.y_p / sums.p;
    const double from_z = z - sums.z_p / sums.p;
    sums.lever += std::max(f[cell], 0.0) * std::sqrt(from_y * from_y + from_z * from_z);
  });
}

/// A sum is taken in eight parts, in the same order on every machine: additions wait for each
/// other.
double sum_of(const double* f, std::size_t count) noexcept {
  constexpr std::size_t parts = 8;
  std::array<double, parts> sums{};
  std::size_t i = 0;
  for (; i + parts <= count; i += parts)
    for (std::size_t k = 0; k < parts; ++k) sums[k] += f[i + k];
  for (; i < count; ++i) sums[0] += f[i];
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

/// The friction that a contact needs, for drag and torsion together.
double friction_needed(const CellSums& sums) noexcept {
  const double twist = sums.lever > 0.0 ? torsion_of(sums) / sums.lever : 0.0;
  return std::hypot(std::hypot(sums.q_y, sums.q_z) / sums.p, twist);
}

/// Of patches that press, the one that is nearest to slipping; absent: they are not two at least.
/// A patch that is nothing beside the strongest one does not count.
const CellSums* nearest_to_slipping(const PlanCells& cells, const double* f, CellMarks& scratch,
                                    ContactEstimate& estimate) noexcept {
  const std::size_t count =
      label_patches({cells.rows, cells.columns, 0, 0}, scratch.marks.data(), scratch.queue.data());
  if (count < 2) return nullptr;
  add_patches(cells, 3, f, count, scratch);
  const CellSums* const patches = scratch.patches.data();
  double strongest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    if (patches[i].lever >= 0.0) strongest = std::max(strongest, patches[i].p);
  const auto counts = [&](const CellSums& patch) {
    return patch.lever >= 0.0 && patch.p > least_share * strongest;
  };
  const auto contacts = std::count_if(patches, patches + count, counts);
  if (contacts < 2) return nullptr;
  estimate.contacts = static_cast<std::size_t>(contacts);
  const CellSums* worst = nullptr;
  double most = -1.0;
  for (std::size_t i = 0; i < count; ++i)
    if (counts(patches[i]) && friction_needed(patches[i]) > most) {
      most = friction_needed(patches[i]);
      worst = &patches[i];
    }
  return worst;
}

/// Margins of the sums, or where several contacts lie apart of the one nearest to slipping.
void add_margins(const PlanCells& cells, const double* f, const std::uint8_t* marks, CellSums sums,
                 double friction, std::size_t patches, CellMarks& scratch,
                 ContactEstimate& estimate) noexcept {
  estimate.contacts = 1;
  if (const CellSums* const worst =
          patches > 1 ? nearest_to_slipping(cells, f, scratch, estimate) : nullptr)
    sums = *worst;
  else
    add_levers(cells, f, marks, [&](std::size_t) -> CellSums& { return sums; });
  const Margins margins = margins_of(sums, cells.area(), friction);
  estimate.friction_margin = margins.friction;
  estimate.slip_margin = margins.slip;
  estimate.margin_centre = cells.centre_y + sums.y_p / sums.p;
  estimate.margin_centre_z = cells.centre_z + sums.z_p / sums.p;
}

/// @param centre  whether the cells press, so that there is one
void add_space(const PlanSpace& space, const double* f, std::size_t unknowns, std::size_t count,
               const std::uint8_t* marks, bool centre, SpaceEstimate& estimate) noexcept {
  estimate.force.fill(0.0);
  estimate.moment.fill(0.0);
  const double* row = space.wrench.data();
  for (std::array<double, 3>* vector : {&estimate.force, &estimate.moment})
    for (double& sum : *vector)
      for (std::size_t u = 0; u < unknowns; ++u, row += count)
        for (std::size_t cell = 0; cell < count; ++cell)
          if (marks == nullptr || marks[cell] != 0) sum += row[cell] * f[u * count + cell];
  if (!centre) return;
  estimate.centre.fill(0.0);
  double all = 0.0;
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (marks != nullptr && marks[cell] == 0) continue;
    all += f[cell];
    for (std::size_t k = 0; k < estimate.centre.size(); ++k)
      estimate.centre[k] += space.places[k * count + cell] * f[cell];
  }
  for (double& place : estimate.centre) place /= all;
}

}  // namespace

double torsion_of(const CellSums& sums) noexcept {
  return sums.torque - sums.y_p / sums.p * sums.q_z + sums.z_p / sums.p * sums.q_y;
}

Touching mark_cells(const PlanCells& cells, const double* p, CellMarks& scratch) noexcept {
  const TouchedWindows windows{cells.window_rows, cells.window_columns,
                               cells.window_deviations.data(), scratch.sums.data(),
                               scratch.along.data()};
  return mark_touching(
      scratch.loops, {cells.rows, cells.columns, cells.rim_rows, cells.rim_columns}, p,
      cells.deviations.data(), cells.window_deviations.empty() ? nullptr : &windows,
      scratch.marks.data(), scratch.queue.data(), [](std::size_t) {});
}

double deviation_of(const PlanCells& cells, double variance, double largest) noexcept {
  const auto window =
      static_cast<double>((2 * cells.window_rows + 1) * (2 * cells.window_columns + 1));
  return std::sqrt(std::max(variance, window * largest));
}

Margins margins_of(const CellSums& sums, double area, double mu) noexcept {
  const double hold = mu * (area * sums.p);
  const double drag = std::hypot(area * sums.q_y, area * sums.q_z);
  Margins margins{.friction = hold - drag};
  if (!(hold > 0.0)) return margins;
  const double turn = mu * area * sums.lever;
  const double twist = turn > 0.0 ? area * torsion_of(sums) / turn : 0.0;
  margins.slip = 1.0 - std::hypot(drag / hold, twist);
  return margins;
}

void add_patches(const PlanCells& cells, std::size_t unknowns, const double* f, std::size_t count,
                 CellMarks& scratch) noexcept {
  constexpr double none = -std::numeric_limits<double>::infinity();
  CellSums* const patches = scratch.patches.data();
  const auto of_patch = [&](std::size_t cell) -> CellSums& { return patches[scratch.queue[cell]]; };
  std::fill_n(patches, count, CellSums{});
  add_cells(cells, unknowns, f, scratch.marks.data(), of_patch);
  for (std::size_t i = 0; i < count; ++i)
    if (!(patches[i].p > 0.0)) patches[i] = {.p = 1.0, .lever = none};
  add_levers(cells, f, scratch.marks.data(), of_patch);
}

void add_skin_resultant(const PlanCells& cells, const PlanSpace* space, std::size_t unknowns,
                        const double* f, const double* linear, std::optional<double> friction,
                        std::span<const double> variances, double certain_force, double highest,
                        double lowest, CellMarks& scratch, ContactEstimate& estimate) noexcept {
  const double area = cells.area();
  const std::size_t count = cells.rows * cells.columns;
  const double all = area * sum_of(linear != nullptr ? linear : f, count);
  const Touching touching = cells.deviations.empty() ? Touching{} : mark_cells(cells, f, scratch);
  estimate.touching = touching.cells;
  const std::uint8_t* const marks = touching.cells > 0 ? scratch.marks.data() : nullptr;
  CellSums sums;
  const bool none_touches = linear != nullptr && !cells.deviations.empty() && marks == nullptr;
  if (none_touches) f = linear;
  const bool nothing = none_touches && !(all > certain_force);  // that noise would not push
  if (nothing) {
    // Forces are 0.
  } else if (marks != nullptr && !variances.empty()) {
    double variance = 0.0;
    double largest = 0.0;
    add_cells(cells, unknowns, f, marks, [&](std::size_t cell) -> CellSums& {
      variance += variances[cell];
      largest = std::max(largest, variances[cell]);
      return sums;
    });
    estimate.force_deviation = deviation_of(cells, variance, largest);
  } else {
    add_cells(cells, unknowns, f, marks, [&](std::size_t) -> CellSums& { return sums; });
    if (marks != nullptr) estimate.force_deviation = ContactEstimate::unknown;
  }

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
  if (space != nullptr)
    add_space(*space, f, unknowns, nothing ? 0 : count, marks, estimate.contact, estimate.space);
  if (!estimate.contact) return;
  estimate.centre = cells.centre_y + sums.y_p / sums.p;
  estimate.centre_z = cells.centre_z + sums.z_p / sums.p;
  if (unknowns == 1) return;
  estimate.angle = std::atan2(estimate.tangential_force, estimate.normal_force);
  estimate.torsion = area * torsion_of(sums);
  if (friction) add_margins(cells, f, marks, sums, *friction, touching.patches, scratch, estimate);
}

}  // namespace tactile_net

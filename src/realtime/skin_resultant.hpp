/// @file
/// What the tractions of a skin amount to, once a frame. Private.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "realtime/aligned.hpp"
#include "realtime/touching_cells.hpp"
#include "realtime/touching_loops.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// Sums of tractions over cells, times an area forces and moments; places from the grid's middle.
struct CellSums {
  double p = 0.0, q_y = 0.0, q_z = 0.0;
  double y_p = 0.0, z_p = 0.0;
  double torque = 0.0;
  double lever = 0.0;  // sum p r, r from the centre of pressure
};

/// Scratch of one thread.
struct CellMarks {
  CellMarks(std::size_t rows, std::size_t columns, bool windows, InstructionSet set)
      : loops(touching_loops(set)),
        marks(rows * columns),
        queue(rows * columns),
        sums(windows ? rows * columns : 0),
        along(windows ? rows * columns : 0),
        patches(((rows + 1) / 2) * ((columns + 1) / 2)) {}

  const TouchingLoops& loops;
  Aligned<std::uint8_t> marks;
  Aligned<std::uint32_t> queue;   // and then the number of each touching cell's patch
  Aligned<double> sums, along;    // over windows, where the plan has any
  std::vector<CellSums> patches;  // as many as can lie apart
};

/// Marks the cells that touch. @pre  the cells have deviations
///
/// @param p  normal tractions
/// @return how many patches and cells there are
Touching mark_cells(const PlanCells& cells, const double* p, CellMarks& scratch) noexcept;

/// About the centre of pressure, over an area. @pre  p > 0
[[nodiscard]] double torsion_of(const CellSums& sums) noexcept;

/// Of a force over some cells. Less than a window errs as much as that: its cells share what is
/// told of them.
/// @param variance, largest  sum and largest of the cells' shares
[[nodiscard]] double deviation_of(const PlanCells& cells, double variance, double largest) noexcept;

/// What friction leaves, as `ContactEstimate` has it.
struct Margins {
  double friction = ContactEstimate::unknown;
  double slip = ContactEstimate::unknown;
};
/// @param sums  with their lever; p > 0
/// @param mu    of friction
[[nodiscard]] Margins margins_of(const CellSums& sums, double area, double mu) noexcept;

/// Sums of each patch of marked cells, and its lever; a patch that does not press has a lever below
/// 0. @pre  `label_patches` numbered so many patches into the queue
void add_patches(const PlanCells& cells, std::size_t unknowns, const double* f, std::size_t count,
                 CellMarks& scratch) noexcept;

/// Fills in forces, centre, torsion, margins, contact and touching. At the cost of `mark_touching`,
/// and where several patches touch of one more look at each cell; no allocation.
///
/// @param space             of a curved skin; null: flat
/// @param f                 tractions: normal, and with three unknowns tangential ones
/// @param linear            those that constraints were laid upon; null: f are linear. Noise can
///                          only push inside constraints, so sums of f over cells that do not touch
///                          are too large: where none touches that could, forces are 0, or those of
///                          the linear ones if these are beyond noise
/// @param variances         of the force, a share for each cell; none: not known
/// @param certain_force     from which the sum over all cells is a contact's, though no single cell
///                          may be
/// @param highest, lowest   sums over all cells beyond are doubted
void add_skin_resultant(const PlanCells& cells, const PlanSpace* space, std::size_t unknowns,
                        const double* f, const double* linear, std::optional<double> friction,
                        std::span<const double> variances, double certain_force, double highest,
                        double lowest, CellMarks& scratch, ContactEstimate& estimate) noexcept;

}  // namespace tactile_net

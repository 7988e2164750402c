/// @file
/// What the tractions of a skin amount to, once a frame. Private.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "realtime/aligned.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// Scratch of one thread.
struct CellMarks {
  CellMarks(std::size_t cells, bool windows)
      : marks(cells), queue(cells), sums(windows ? cells : 0), along(windows ? cells : 0) {}

  Aligned<std::uint8_t> marks;
  Aligned<std::uint32_t> queue;
  Aligned<double> sums, along;  // over windows, where the plan has any
};

/// Fills in forces, centre, torsion, margins, contact and touching. At the cost of `mark_touching`;
/// no allocation.
///
/// @param f                 tractions: normal, and with three unknowns tangential ones
/// @param certain_force     from which the sum over all cells is a contact's, though no single cell
///                          may be
/// @param highest, lowest   sums over all cells beyond are doubted
void add_skin_resultant(const PlanCells& cells, std::size_t unknowns, const double* f,
                        std::optional<double> friction, double certain_force, double highest,
                        double lowest, CellMarks& scratch, ContactEstimate& estimate) noexcept;

}  // namespace tactile_net

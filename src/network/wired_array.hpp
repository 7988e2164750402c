/// @file
/// An array whose lines have resistance: what its ends see in place of its cells. Private.
///
/// Row i ends at a node, line c at another, both at the corner of cell (0, 0). A segment of `ohm`
/// lies between neighbouring crossings, and between the first crossing and the end.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

struct ArrayCell {
  std::size_t row = 0;
  std::size_t line = 0;
  double siemens = 0.0;
};

/// @param ohm  > 0
/// @return     the current into row i's end per volt at line c's, all other ends at 0 V [S], rows x
///             lines; one sparse decomposition of 2 rows lines unknowns, and as many solutions as
///             there are rows
[[nodiscard]] Matrix seen_from_ends(std::span<const ArrayCell> cells, std::size_t rows,
                                    std::size_t lines, double ohm);

/// The conductance that each two ends have between them [S], the rows' ends first: together the
/// array as its ends see it, whatever their voltages. Symmetric; the diagonal is 0. As many
/// solutions as there are ends.
///
/// @param ohm  > 0
[[nodiscard]] Matrix between_ends(std::span<const ArrayCell> cells, std::size_t rows,
                                  std::size_t lines, double ohm);

}  // namespace tactile_net

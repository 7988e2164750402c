/// @file
/// A ladder: resistors from amplifiers' outputs y to nodes of the voltages f with R f = d y. A
/// difference of two f is then the current of one resistor, whatever its error. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// Resistors at one node. Another one of feed |R_ij| / d joins it to each node j that R couples.
struct LadderNode {
  std::size_t block = 0;   ///< nodes that R couples, however far, have the same block
  double d = 0.0;          ///< in units of R, of the whole block
  double feed = 0.0;       ///< from y to f [S], of the whole block
  double to_ground = 0.0;  ///< feed (sum_j R_ij / d - 1) [S], the node's own load in it
};

/// The resistors to ground take at least as much as the feeds do, and at least each node's load,
/// so that what is left of them is a resistor.
///
/// @param stabiliser  R, symmetric
/// @param loads  what a node is loaded with already, by nodes at 0 V [S], >= 0, not all of them 0
/// @throw std::invalid_argument  R has an entry > 0 beside its diagonal, or a row whose sum is not
///                               > 0: no resistors make it
[[nodiscard]] std::vector<LadderNode> ladder_of(const Matrix& stabiliser,
                                                std::span<const double> loads);

}  // namespace tactile_net

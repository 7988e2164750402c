/// @file
/// The waves of the stabiliser along one axis of a grid: cosines where its ends are free, sines
/// where tractions fall to 0 beyond them. Private.
#pragma once

#include <cstddef>

#include "numeric/eigen.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// Column m, of unit norm: cos(pi m (i + 1/2) / count), or sin(pi (m + 1) (i + 1) / (count + 1)).
/// Its mirror image is itself for even m and its negative for odd m, to the bit.
///
/// @param waves  the first so many, <= count
[[nodiscard]] Eigen::MatrixXd axis_waves(std::size_t count, std::size_t waves, Boundary boundary);

/// The squared differences of neighbours in wave m, over its squared norm; where tractions fall to
/// 0 beyond the ends, with those to 0.
[[nodiscard]] double roughness(std::size_t m, std::size_t count, Boundary boundary);

}  // namespace tactile_net

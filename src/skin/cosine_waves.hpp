/// @file
/// Cosines along one axis of the cells: the waves of the stabiliser, whose ends are free. Private.
#pragma once

#include <cstddef>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// Column m: cos(pi m (i + 1/2) / count), of unit norm; of even or odd parity to the bit.
///
/// @param waves  the first so many, <= count
[[nodiscard]] Eigen::MatrixXd cosine_waves(std::size_t count, std::size_t waves);

/// The squared differences of neighbours in wave m, over its squared norm.
[[nodiscard]] double roughness(std::size_t m, std::size_t count);

}  // namespace tactile_net

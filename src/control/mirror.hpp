/// @file
/// Mirror symmetry of a matrix between blocks of an array; see realtime/product_plan.hpp. Private.
#pragma once

#include <cstdint>
#include <vector>

#include "numeric/eigen.hpp"

namespace tactile_net {

using Signs = std::vector<std::int8_t>;

/// Orthonormal basis of class 0 (J x = x) or 1 (J x = -x), size x class size, in the order of
/// `split`: block after block, the sums of a block with its own sign, else the differences.
[[nodiscard]] Eigen::MatrixXd class_basis(const Signs& signs, Eigen::Index size, int which);

/// What a plain sum or difference has to be multiplied by to be a coordinate of that basis:
/// 1 / sqrt(2), and 1 for the centre of an odd block.
[[nodiscard]] Eigen::VectorXd class_scale(const Signs& signs, Eigen::Index size, int which);

/// J A J.
[[nodiscard]] Eigen::MatrixXd mirrored(const Eigen::MatrixXd& a, const Signs& rows,
                                       const Signs& columns);

}  // namespace tactile_net

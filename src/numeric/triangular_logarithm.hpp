/// @file
/// The logarithm of a triangular matrix. Private.
#pragma once

#include <Eigen/Core>

namespace tactile_net {

/// log T, principal, by inverse scaling and squaring (Higham 2008, algorithm 11.9): square roots
/// (Bjorck and Hammarling 1983) until T is near 1, then Gauss' rule for x -> X / (1 + x X) on 0 ...
/// 1, with the diagonal's logarithms in place of what that makes of them. About rows^3 operations,
/// and a third of that a root.
///
/// Eigen's own goes by blocks of eigenvalues apart by 0.1 or more, whatever their size: next to a
/// largest of 1e8 they are as good as equal, and digits are lost.
///
/// @param t  upper triangular; no element of its diagonal is 0 or negative
[[nodiscard]] Eigen::MatrixXcd triangular_logarithm(Eigen::MatrixXcd t);

}  // namespace tactile_net

/// @file
/// Whether what is left over is within its deviations. Private.
#pragma once

#include <optional>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// rest' C^-1 rest, by the correlations, so that units do not matter; absent if C has no inverse.
[[nodiscard]] std::optional<double> chi_squared(const Eigen::VectorXd& rest,
                                                const Eigen::MatrixXd& c);

}  // namespace tactile_net

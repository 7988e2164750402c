/// @file
/// The stabiliser L of problem.hpp, L'L = l^2/D^2 Q + I, as a function of f. Private.
#pragma once

#include "inverse/eigen.hpp"
#include "tactile_net/inverse/problem.hpp"

namespace tactile_net {

/// |L f|_2^2 = |f|^2 + l^2/D^2 sum of the squared differences between neighbours.
[[nodiscard]] inline double stabiliser_square(const InverseProblem& problem,
                                              const Eigen::Ref<const Eigen::VectorXd>& f) {
  const double ratio = problem.smoothing_length / problem.pitch;
  const auto n = static_cast<Eigen::Index>(problem.count);
  double sum = f.squaredNorm();
  for (Eigen::Index start = 0; start < f.size(); start += n)
    sum += ratio * ratio * (f.segment(start + 1, n - 1) - f.segment(start, n - 1)).squaredNorm();
  return sum;
}

}  // namespace tactile_net

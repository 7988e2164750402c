#include "inverse/weighting.hpp"

namespace tactile_net {

Weighting::Weighting(const InverseProblem& problem)
    : weights_(as_eigen(std::span(problem.weights))), constants_(weights_.size(), 0) {
  if (!problem.unknown_offsets) return;
  constants_.setZero(weights_.size(), static_cast<Eigen::Index>(problem.sites.back().channel) + 1);
  for (Eigen::Index i = 0; i < weights_.size(); ++i)
    constants_(i, static_cast<Eigen::Index>(problem.sites[static_cast<std::size_t>(i)].channel)) =
        weights_(i);
  for (Eigen::Index c = 0; c < constants_.cols(); ++c) constants_.col(c).normalize();
}

}  // namespace tactile_net

#include "inverse/weighting.hpp"

namespace tactile_net {

Eigen::MatrixXd channel_constants(const InverseProblem& problem) {
  const auto channels = static_cast<Eigen::Index>(problem.sites.back().channel) + 1;
  Eigen::MatrixXd constants = Eigen::MatrixXd::Zero(std::ssize(problem.weights), channels);
  for (std::size_t i = 0; i < problem.sites.size(); ++i)
    constants(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(problem.sites[i].channel)) =
        problem.weights[i];
  for (Eigen::Index c = 0; c < channels; ++c) constants.col(c).normalize();
  return constants;
}

Weighting::Weighting(const InverseProblem& problem)
    : weights_(as_eigen(std::span(problem.weights))), constants_(weights_.size(), 0) {
  if (problem.unknown_offsets) constants_ = channel_constants(problem);
}

}  // namespace tactile_net

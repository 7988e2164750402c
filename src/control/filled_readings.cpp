#include "control/filled_readings.hpp"

#include <cstddef>

#include "inverse/weighting.hpp"

namespace tactile_net {

using Eigen::Index;

Eigen::MatrixXd filled_readings(const LinearProblem& problem, const LinearProblem& whole,
                                const Eigen::MatrixXd& reconstruction,
                                const Eigen::VectorXd& weights) {
  const Eigen::MatrixXd kernel = as_eigen(whole.kernel);
  // Where offsets are unknown: the constant that the live readings of a channel leave to it, of the
  // live readings, in the unit of a weighted one.
  const Weighting live(problem);
  const Eigen::MatrixXd sums = live.constants().transpose();
  const Eigen::MatrixXd left = sums - (sums * kernel) * reconstruction;
  const Eigen::VectorXd sizes = sums * live.weights();
  const Index n = live.size();
  Eigen::MatrixXd filled = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    if (live.weights()(i) > 0.0) {
      filled(i, i) = 1.0;
      continue;
    }
    filled.row(i) = kernel.row(i) * reconstruction;
    if (!problem.unknown_offsets) continue;
    const auto channel = static_cast<Index>(problem.sites[static_cast<std::size_t>(i)].channel);
    if (sizes(channel) > 0.0) filled.row(i) += weights(i) / sizes(channel) * left.row(channel);
  }
  return filled;
}

Factor fill_factor(const LinearProblem& problem, const Eigen::MatrixXd& filled,
                   const Eigen::VectorXd& factors) {
  Factor rows{.rows = 0, .columns = static_cast<std::size_t>(filled.cols())};
  for (Index i = 0; i < filled.rows(); ++i) {
    if (problem.weights[static_cast<std::size_t>(i)] > 0.0) continue;
    ++rows.rows;
    for (Index j = 0; j < filled.cols(); ++j)
      rows.values.push_back(filled(i, j) * (factors(j) / factors(i)));
  }
  return rows;
}

}  // namespace tactile_net

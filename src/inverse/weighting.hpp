/// @file
/// From readings to what the rows of a problem explain, P W g of problem.hpp; a line's problem and
/// a skin's, which both have `weights`, `sites` and `unknown_offsets`. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// The rows' weights of each channel, over their 2-norm, a column each; zeros where all of its
/// taxels are dead.
template <typename Problem>
[[nodiscard]] Eigen::MatrixXd channel_constants(const Problem& problem) {
  const auto channels = static_cast<Eigen::Index>(problem.sites.back().channel) + 1;
  Eigen::MatrixXd constants = Eigen::MatrixXd::Zero(std::ssize(problem.weights), channels);
  for (std::size_t i = 0; i < problem.sites.size(); ++i)
    constants(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(problem.sites[i].channel)) =
        problem.weights[i];
  for (Eigen::Index c = 0; c < channels; ++c) constants.col(c).normalize();
  return constants;
}

/// P = I - C C', C the channels' constants where offsets are unknown, else without a column.
class Weighting {
 public:
  template <typename Problem>
  explicit Weighting(const Problem& problem)
      : weights_(as_eigen(std::span(problem.weights))), constants_(weights_.size(), 0) {
    if (problem.unknown_offsets) constants_ = channel_constants(problem);
  }

  [[nodiscard]] Eigen::Index size() const noexcept { return weights_.size(); }
  /// Independent numbers in a frame.
  [[nodiscard]] Eigen::Index rows() const {
    return (weights_.array() != 0.0).count() -
           (constants_.colwise().squaredNorm().array() > 0.0).count();
  }

  /// Diagonal of W.
  [[nodiscard]] const Eigen::VectorXd& weights() const noexcept { return weights_; }
  /// C.
  [[nodiscard]] const Eigen::MatrixXd& constants() const noexcept { return constants_; }

  /// P W g.
  [[nodiscard]] Eigen::VectorXd operator()(std::span<const double> readings) const {
    return projected(weights_.cwiseProduct(as_eigen(readings)));
  }
  /// P X.
  [[nodiscard]] Eigen::MatrixXd projected(Eigen::MatrixXd x) const {
    if (constants_.cols() > 0) x -= constants_ * (constants_.transpose() * x);
    return x;
  }
  /// M P W: a pseudo-inverse of the problem's rows, applied to readings as they are.
  [[nodiscard]] Eigen::MatrixXd applied(Eigen::MatrixXd inverse) const {
    if (constants_.cols() > 0) inverse -= (inverse * constants_) * constants_.transpose();
    return inverse * weights_.asDiagonal();
  }

 private:
  Eigen::VectorXd weights_;
  Eigen::MatrixXd constants_;
};

/// P W K for W K, where offsets are unknown, and what P takes: `constants` of the problem.
///
/// @param taken  C of what has been taken before
template <typename Problem>
void take_offsets_out(Problem& problem, const Eigen::MatrixXd& taken = {}) {
  if (!problem.unknown_offsets) return;
  const Weighting weighting(problem);
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  Eigen::MatrixXd constants = weighting.constants().transpose() * kernel;
  problem.kernel_error =
      std::hypot(problem.kernel_error, std::numeric_limits<double>::epsilon() * constants.norm());
  if (taken.size() > 0)
    constants += weighting.constants().transpose() * taken * as_eigen(problem.constants);
  problem.constants = from_eigen(constants);
  problem.kernel = from_eigen(weighting.projected(kernel));
}

/// A kernel of which nothing but rounding is left is 0: readings that depend on no traction would
/// be explained by tractions 1e16 times too large.
template <typename Problem>
void drop_kernel_of_rounding(Problem& problem) {
  std::vector<double>& entries = problem.kernel.values;
  const double rounding = 4.0 * problem.kernel_error;  // and that of a projection
  if (std::all_of(entries.begin(), entries.end(),
                  [&](double entry) { return std::abs(entry) <= rounding; }))
    std::fill(entries.begin(), entries.end(), 0.0);
}

/// Leaves taxels out, as if they had been dead when the problem was made.
template <typename Problem>
void leave_taxels_out(Problem& problem, std::span<const std::size_t> taxels) {
  const Eigen::MatrixXd taken = Weighting(problem).constants();
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    if (std::find(taxels.begin(), taxels.end(), problem.sites[row].taxel) == taxels.end()) continue;
    problem.weights[row] = 0.0;
    for (std::size_t column = 0; column < problem.kernel.columns; ++column)
      problem.kernel(row, column) *= 0.0;  // as make_problem does, sign and all
  }
  // What was taken from more rows is constant in those that are left, too.
  take_offsets_out(problem, taken);
  drop_kernel_of_rounding(problem);
}

/// The offset of each channel that these tractions leave to its readings; none where offsets are
/// known. @throw std::invalid_argument  readings or tractions do not fit the problem
template <typename Problem>
[[nodiscard]] std::vector<double> offsets_of(const Problem& problem,
                                             std::span<const double> readings,
                                             std::span<const double> tractions) {
  check_size(readings, problem.weights.size());
  check_tractions(tractions, problem.kernel.columns);
  if (!problem.unknown_offsets) return {};
  const Weighting weighting(problem);
  const Eigen::VectorXd left =
      weighting.constants().transpose() * weighting.weights().cwiseProduct(as_eigen(readings)) -
      as_eigen(problem.constants) * as_eigen(tractions);
  const Eigen::VectorXd size = weighting.constants().transpose() * weighting.weights();
  std::vector<double> result;
  for (Eigen::Index c = 0; c < left.size(); ++c)
    result.push_back(size(c) > 0.0 ? left(c) / size(c) : 0.0);
  return result;
}

}  // namespace tactile_net

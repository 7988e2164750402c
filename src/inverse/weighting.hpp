/// @file
/// From readings to what the rows of a problem explain, P W g of linear_problem.hpp. Private.
#pragma once

#include <cstddef>
#include <span>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// P = I - C C', C the channels' constants where offsets are unknown, else without a column.
class Weighting {
 public:
  explicit Weighting(const LinearProblem& problem)
      : Weighting(problem.weights, problem.sites, problem.unknown_offsets) {}
  /// @param weights  diagonal of W
  /// @param sites    one per weight
  Weighting(std::span<const double> weights, std::span<const Site> sites, bool unknown_offsets);

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

/// The rows' weights of each channel, over their 2-norm, a column each; zeros where all of its
/// taxels are dead.
[[nodiscard]] Eigen::MatrixXd channel_constants(std::span<const double> weights,
                                                std::span<const Site> sites);

}  // namespace tactile_net

/// @file
/// A line's cone of friction by its two edges at each place, f_v = a + b and f_t = limit (a - b)
/// with a, b >= 0: the variables a of all places, then b. Without a limit the tractions themselves.
/// Private.
#pragma once

#include <optional>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/constrained.hpp"

namespace tactile_net {

class ConeEdges {
 public:
  /// @throw std::invalid_argument  the problem is a skin's; friction_limit is not > 0 and finite,
  /// or
  ///                               there is one unknown only
  ConeEdges(const LinearProblem& problem, const Constraints& constraints)
      : limit_(constraints.friction_limit) {
    require_line(problem);
    if (!limit_) return;
    check_friction_limit(*limit_);
    if (problem.components != 2)
      throw std::invalid_argument("a friction limit needs the tangential traction as an unknown");
  }

  [[nodiscard]] std::optional<double> limit() const noexcept { return limit_; }

  /// What a matrix whose columns are tractions makes of the variables.
  [[nodiscard]] Eigen::MatrixXd applied(Eigen::MatrixXd matrix) const {
    if (!limit_) return matrix;
    const Eigen::Index n = matrix.cols() / 2;
    matrix.rightCols(n) *= *limit_;
    const Eigen::MatrixXd normal = matrix.leftCols(n);
    matrix.leftCols(n) += matrix.rightCols(n);
    matrix.rightCols(n) = normal - matrix.rightCols(n);
    return matrix;
  }

  /// f [Pa] of the variables.
  [[nodiscard]] Eigen::VectorXd tractions(const Eigen::VectorXd& variables) const {
    if (!limit_) return variables;
    const Eigen::Index n = variables.size() / 2;
    Eigen::VectorXd f(variables.size());
    f.head(n) = variables.head(n) + variables.tail(n);
    f.tail(n) = *limit_ * (variables.head(n) - variables.tail(n));
    return f;
  }

 private:
  std::optional<double> limit_;
};

}  // namespace tactile_net

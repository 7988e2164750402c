/// @file
/// How far a circuit's outputs are from their end. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/network/state_space.hpp"

namespace tactile_net {

/// x at the end, -A^-1 b.
[[nodiscard]] Eigen::VectorXd end_of(const StateSpace& system);

/// x as the readings have just come, -A^-1 `idle_drive` and their `jump`.
[[nodiscard]] Eigen::VectorXd start_of(const StateSpace& system);

/// C (x - x_end), where x - x_end begins at `start` and follows exp(A t).
class Deviation {
 public:
  Deviation(const StateSpace& system, Eigen::VectorXd start);

  /// |v - v_end|_2 at t = 0, step, ... : exact at each, however far apart they are.
  [[nodiscard]] std::vector<double> sizes(double step, std::size_t steps) const;

  /// When it stays within `limit` [V] for good [s], to a thousandth of itself.
  ///
  /// @param horizon  [s], where to look first, > 0
  [[nodiscard]] std::optional<double> within(double limit, double horizon) const;

 private:
  Eigen::MatrixXd a_;
  Eigen::MatrixXd c_;
  Eigen::VectorXd start_;
};

}  // namespace tactile_net

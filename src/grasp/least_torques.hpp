/// @file
/// The contact forces in equilibrium whose torques are least. Private.
#pragma once

#include <optional>
#include <vector>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// min |T v|^2 under C v = d and, if `bounded`, v >= 0. T and C have no unit.
struct LeastTorques {
  Eigen::MatrixXd t;
  Eigen::MatrixXd c;
  Eigen::VectorXd d;
  bool bounded = false;

  /// The matrix of  I s + T v = 0,  C v = d, v_held = 0,  T's + [C; held]'l = 0, in that order: the
  /// minimum without the square of T's condition number. s is minus the torques.
  [[nodiscard]] Eigen::MatrixXd system(const std::vector<Eigen::Index>& held = {}) const;

  /// Which bounds hold in the minimum, by Goldfarb and Idnani's dual method (Mathematical
  /// Programming 27, 1983): from the minimum without bounds, one violated bound after another.
  /// Those held are linearly independent of C's rows. Nothing if no v >= 0 has C v = d.
  ///
  /// Needs a regular `system()`.
  [[nodiscard]] std::optional<std::vector<Eigen::Index>> held_bounds() const;
};

}  // namespace tactile_net

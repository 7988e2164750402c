/// @file
/// The least of some linear forms among forces in equilibrium, of contacts whose cones are two
/// edges each: those of a plane. Private.
#pragma once

#include <optional>
#include <vector>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// min |T v|^2 under C v = d and, if `bounded`, v >= 0: forces along the edges. T and C have no
/// unit.
struct LeastOnEdges {
  Eigen::MatrixXd t;
  Eigen::MatrixXd c;
  Eigen::VectorXd d;
  bool bounded = false;

  /// The matrix of  I s + T v = 0,  C v = d, v_held = 0,  T's + [C; held]'l = 0, in that order: the
  /// minimum without the square of T's condition number. s is minus the torques.
  [[nodiscard]] Eigen::MatrixXd system(const std::vector<Eigen::Index>& held = {}) const;

  /// Its condition number.
  [[nodiscard]] double condition(const std::vector<Eigen::Index>& held = {}) const;

  /// Which bounds hold in the minimum, by Goldfarb and Idnani's dual method (Mathematical
  /// Programming 27, 1983): from the minimum without bounds, one violated bound after another.
  /// Those held are linearly independent of C's rows. Nothing if no v >= 0 has C v = d.
  ///
  /// Needs a regular `system()`.
  ///
  /// @throw CannotHoldInSpace  the search did not end
  [[nodiscard]] std::optional<std::vector<Eigen::Index>> held_bounds() const;
};

/// The minimum in the unknowns x = B v of a `LeastInCones`, and what its derivatives need: as
/// `LeastPoint` has them. Forces that are held at 0 stay there.
class EdgePoint {
 public:
  /// @param edges  B
  /// @param held   of the minimum
  EdgePoint(LeastOnEdges problem, Eigen::MatrixXd edges, std::vector<Eigen::Index> held);

  [[nodiscard]] Eigen::VectorXd x() const { return x_of(z_); }
  [[nodiscard]] Eigen::VectorXd minus_mx() const { return z_.head(problem_.t.rows()); }
  [[nodiscard]] Eigen::VectorXd multipliers() const {
    return z_.segment(problem_.t.rows(), problem_.c.rows());
  }
  [[nodiscard]] double condition() const { return problem_.condition(held_); }
  [[nodiscard]] double residual() const;
  [[nodiscard]] double optimality() const;
  [[nodiscard]] Eigen::VectorXd change(const Eigen::VectorXd& by_m, const Eigen::VectorXd& by_c,
                                       const Eigen::VectorXd& by_x) const;

 private:
  [[nodiscard]] Eigen::VectorXd x_of(const Eigen::VectorXd& solution) const;

  LeastOnEdges problem_;
  Eigen::MatrixXd edges_;
  std::vector<Eigen::Index> held_;
  Eigen::MatrixXd system_;
  CompleteLu lu_;
  Eigen::VectorXd z_;    // r, y, multipliers of what is held, v
  Eigen::VectorXd off_;  // what the system leaves of it
};

}  // namespace tactile_net

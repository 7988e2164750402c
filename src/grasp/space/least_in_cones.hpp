/// @file
/// The least of some linear forms among forces in equilibrium and inside their cones. Private.
#pragma once

#include <vector>

#include "grasp/space/cone_program.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// min |M x|^2 under C x = d, and x_i in the cone x_0 >= |(x_1, ...)| of each contact's size; no
/// cones: none. The rows of C are independent, and M and C together determine x.
struct LeastInCones {
  Eigen::MatrixXd m;
  Eigen::MatrixXd c;
  Eigen::VectorXd d;
  std::vector<Eigen::Index> cones;

  /// As a cone program: (t, u = M x, x), t >= |u|, the least t.
  [[nodiscard]] ConeProgram program() const;
};

/// The minimum: x, and what its derivatives need.
class LeastPoint {
 public:
  /// Newton's method on the conditions for a minimum, from an inner point's answer, with the cones
  /// that it meets: x_0 = |x_1...| held for those, x = 0 for those it vanishes in.
  ///
  ///     r + M x = 0,  C x = d,  (|x_1..|^2 - x_0^2) / 2 = 0 or x = 0,  M'r + C'y + (that)' l = 0
  ///
  /// Which cones the minimum meets the answer tells by which is larger, x or its multiplier; where
  /// that was wrong, the point found says so, and it is mended.
  ///
  /// @param x, s  of the inner point; empty: there are no cones
  LeastPoint(const LeastInCones& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& s);

  [[nodiscard]] Eigen::VectorXd x() const { return z_.segment(problem_.m.rows(), columns()); }
  /// -M x, and the multipliers of C.
  [[nodiscard]] Eigen::VectorXd minus_mx() const { return z_.head(problem_.m.rows()); }
  [[nodiscard]] Eigen::VectorXd multipliers() const {
    return z_.segment(problem_.m.rows() + columns(), problem_.c.rows());
  }
  /// |C x - d| over |d|, and the last condition over its terms.
  [[nodiscard]] double residual() const;
  [[nodiscard]] double optimality() const;
  /// How far x is beyond its cones, or multipliers beyond theirs, over their sizes.
  [[nodiscard]] double violation() const { return worst().size; }

  /// dx of the minimum, where dM x, dC x - dd and dM'r + dC'y are known.
  [[nodiscard]] Eigen::VectorXd change(const Eigen::VectorXd& by_m, const Eigen::VectorXd& by_c,
                                       const Eigen::VectorXd& by_x) const;

 private:
  enum class Met { inside, edge, tip };

  [[nodiscard]] Eigen::Index columns() const { return problem_.m.cols(); }
  /// Calls of(first, size, met, its first multiplier) for each cone.
  void each(const auto& of) const;
  void begin(const Eigen::VectorXd& start);
  void converge();
  struct Violation {
    double size = 0.0;     ///< of x beyond its cone, or of its multiplier; over their sizes
    std::size_t cone = 0;  ///< the worst
    Met rather = Met::inside;
  };
  [[nodiscard]] Violation worst() const;
  [[nodiscard]] Eigen::VectorXd conditions() const;
  [[nodiscard]] Eigen::MatrixXd derivative() const;

  const LeastInCones& problem_;
  std::vector<Met> met_;
  Eigen::VectorXd z_;  // r, x, y, l
};

}  // namespace tactile_net

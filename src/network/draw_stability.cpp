#include "network/draw_stability.hpp"

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// Nodes that nothing drives, and inputs' common voltages, follow at once: they are eliminated.
bool is_stable_floating(const Reduction& reduction, const Equations& equations) {
  const Eigen::MatrixXd s = as_eigen(equations.matrix);
  const Eigen::MatrixXd t = as_eigen(equations.input);
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  const Eigen::Index rest = s.rows() - n;
  const Lu followers(s.bottomRightCorner(rest, rest));
  const auto without_followers = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
    const Eigen::MatrixXd below = columns.bottomRows(rest);
    return columns.topRows(n) - s.topRightCorner(n, rest) * followers.solve(below);
  };
  const Eigen::MatrixXd stiffness = without_followers(s.leftCols(n));
  const Eigen::MatrixXd inertia = without_followers(t);
  return eigenvalues(Lu(inertia).solve(stiffness)).real().minCoeff() > 0.0;
}

}  // namespace

bool is_stable(const Reduction& reduction, const Equations& equations) {
  if (!equations.input.values.empty()) return is_stable_floating(reduction, equations);
  const auto s = as_eigen(equations.matrix);
  const Eigen::MatrixXd symmetric = 0.5 * (s + s.transpose());
  if (is_positive_definite(symmetric)) return true;
  // An odd number of real eigenvalues on the wrong side shows in the determinant's sign.
  if (Lu(s).negative_determinant()) return false;
  Eigen::VectorXd inverse(s.rows());
  for (Eigen::Index i = 0; i < s.rows(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    inverse(i) = reduction.is_amplifier(row) ? 1.0 / equations.total[row] : 1.0;
  }
  return eigenvalues(inverse.asDiagonal() * s).real().minCoeff() > 0.0;
}

}  // namespace tactile_net

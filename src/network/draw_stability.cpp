#include "network/draw_stability.hpp"

#include "network/amplifier_equations.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
bool is_stable(const Reduction& reduction, const Equations& equations) {
  if (!equations.input.values.empty()) {
    const AmplifierEquations own = amplifier_equations(reduction, equations);
    return eigenvalues(Lu(own.inertia).solve(own.stiffness)).real().minCoeff() > 0.0;
  }
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

#include "network/draw_stability.hpp"

#include "network/amplifier_equations.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& a) { return 0.5 * (a + a.transpose()); }

/// M x' = -K x with M symmetric and K's symmetric part definite: x'M x falls. Beyond rounding.
bool falls(const AmplifierEquations& own) {
  const Eigen::MatrixXd& inertia = own.inertia;
  if ((inertia - inertia.transpose()).norm() > 1e-12 * inertia.norm()) return false;
  Eigen::MatrixXd stiffness = symmetric_part(own.stiffness);
  stiffness.diagonal().array() -= 1e-10 * stiffness.norm();
  return is_positive_definite(symmetric_part(inertia)) && is_positive_definite(stiffness);
}

}  // namespace

bool is_stable(const Reduction& reduction, const Equations& equations) {
  if (!equations.input.values.empty()) {
    const AmplifierEquations own = amplifier_equations(reduction, equations);
    if (falls(own)) return true;
    return eigenvalues(Lu(own.inertia).solve(own.stiffness)).real().minCoeff() > 0.0;
  }
  const auto s = as_eigen(equations.matrix);
  if (is_positive_definite(symmetric_part(s))) return true;
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

#include "network/amplifier_equations.hpp"

#include <vector>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

AmplifierEquations amplifier_equations(const Reduction& reduction, const Equations& equations) {
  const Eigen::MatrixXd s = as_eigen(equations.matrix);
  std::vector<Eigen::Index> amplifiers;
  std::vector<Eigen::Index> followers;
  for (std::size_t row = 0; row < reduction.rows(); ++row)
    (reduction.is_amplifier(row) ? amplifiers : followers)
        .push_back(static_cast<Eigen::Index>(row));
  AmplifierEquations result{.stiffness = s(amplifiers, amplifiers)};
  if (equations.input.values.empty()) {
    const Eigen::VectorXd total = as_eigen(std::span(equations.total));
    result.inertia = total(amplifiers).asDiagonal();
    return result;
  }
  const Eigen::MatrixXd t = as_eigen(equations.input);
  result.followers = s(followers, followers);
  result.from_inputs = t(followers, Eigen::indexing::all);
  result.into_rows = s(amplifiers, followers);
  const Lu own(result.followers);
  const Eigen::MatrixXd from_outputs = s(followers, amplifiers);
  result.stiffness -= result.into_rows * own.solve(from_outputs);
  result.inertia =
      t(amplifiers, Eigen::indexing::all) - result.into_rows * own.solve(result.from_inputs);
  return result;
}

}  // namespace tactile_net

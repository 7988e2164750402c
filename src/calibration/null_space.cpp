#include "calibration/null_space.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/fit_system.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

constexpr double null_limit = 1e-8;  // the weakest real direction is at 2e-3, rounding at 1e-10
constexpr double share_limit = 1e-3;

}  // namespace

std::vector<NullDirection> null_directions(const FitProblem& problem, const FitState& state) {
  const PressReadings readings = problem.readings(state, true);
  const SystemColumns columns = system_columns(problem, state, readings);
  const FitSystem system =
      fit_system(problem, state, readings, columns,
                 {.damping = 0.0, .common_priors = false, .weak_priors = false});
  Eigen::VectorXd norm = columns.seen;
  // A column that is nothing but the rounding of what is zero is zero.
  const double largest = norm.maxCoeff();
  Eigen::MatrixXd scaled = system.triangle;
  for (Eigen::Index c = 0; c < scaled.cols(); ++c) {
    if (norm(c) <= 1e-12 * largest) {
      scaled.col(c).setZero();
      norm(c) = 1.0;
    } else {
      scaled.col(c) /= norm(c);
    }
  }
  const Svd svd = singular_value_decomposition(scaled);
  std::vector<NullDirection> directions;
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) {
    if (svd.values(k) > null_limit * svd.values(0)) continue;
    NullDirection direction;
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (const std::size_t column = problem.pad_column(static_cast<PadParameter>(i));
          column != no_column)
        direction.pad[i] = svd.v(static_cast<Eigen::Index>(column), k);
    for (std::size_t j = 0; j < problem.model().sites().size(); ++j) {
      const std::size_t column = problem.gain_column(j);
      direction.gains.push_back(column == no_column ? 0.0
                                                    : svd.v(static_cast<Eigen::Index>(column), k));
    }
    directions.push_back(std::move(direction));
  }
  return directions;
}

bool takes_part(const std::vector<NullDirection>& directions, PadParameter parameter) {
  double sum = 0.0;
  for (const NullDirection& direction : directions)
    sum = std::hypot(sum, direction.pad[static_cast<std::size_t>(parameter)]);
  return sum > share_limit;
}

}  // namespace tactile_net

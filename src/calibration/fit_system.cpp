#include "calibration/fit_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/reading_system.hpp"
#include "calibration/triangle.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// The rows of one press: its own columns, the common ones, the negative residual.
class PressBlock {
 public:
  PressBlock(const FitProblem& problem, const FitState& state, const PressReadings& readings,
             std::size_t p, const SystemParts& parts)
      : own_(problem.press_rows[p].columns) {
    const std::vector<PressPrior> priors = problem.press_priors(state, p);
    matrix.setZero(eigen_index(problem.readings_used() + priors.size() + own_),
                   eigen_index(own_ + problem.columns() + 1));
    const FitRows rows(problem, state, readings, parts);
    RowPlaces at{.pad = own_};
    for (std::size_t j = 0; j < problem.model().sites().size(); ++j) {
      if (!problem.used(j)) continue;
      const std::size_t gain = problem.gain_column(j);
      at.gain = gain == no_column ? no_column : own_ + gain;
      at.offset = own_ + problem.offset_column(j);
      rows.put_reading(p, j, at, matrix, filled++);
    }
    for (const PressPrior& prior : priors)
      if (!prior.is_weak || parts.weak_priors) rows.put_prior(p, prior, at, matrix, filled++);
  }

  void eliminate() { eliminate_columns(matrix, eigen_index(own_)); }

  Eigen::MatrixXd matrix{};
  Eigen::Index filled = 0;  ///< rows; those below are for damping

 private:
  std::size_t own_;
};

}  // namespace

SystemColumns system_columns(const FitProblem& problem, const FitState& state,
                             const PressReadings& readings) {
  const Eigen::Index t = eigen_index(problem.columns());
  SystemColumns result{Eigen::VectorXd::Zero(t), Eigen::VectorXd::Zero(t), {}};
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    const PressBlock block(problem, state, readings, p, {});
    const auto own = eigen_index(problem.press_rows[p].columns);
    const auto common = block.matrix.middleCols(own, t);
    result.norm += common.colwise().squaredNorm().transpose();
    result.gradient -= common.transpose() * block.matrix.rightCols(1);
    std::array<double, press_unknowns> norms{};
    for (std::size_t i = 0; i < press_unknowns; ++i) {
      const std::size_t column = problem.press_rows[p].column[i];
      norms[i] = column == no_column ? 0.0 : block.matrix.col(eigen_index(column)).norm();
    }
    result.press_norm.push_back(norms);
  }
  result.seen = result.norm.cwiseSqrt();
  const Eigen::MatrixXd priors = problem.common_priors(state);
  result.norm += priors.leftCols(t).colwise().squaredNorm().transpose();
  result.gradient += priors.leftCols(t).transpose() * priors.rightCols(1);
  result.norm = result.norm.cwiseSqrt();
  for (double& norm : result.norm)
    if (norm == 0.0) norm = 1.0;
  return result;
}

FitSystem fit_system(const FitProblem& problem, const FitState& state,
                     const PressReadings& readings, const SystemColumns& columns,
                     const SystemParts& parts) {
  const Eigen::Index t = eigen_index(problem.columns());
  const double root = std::sqrt(parts.damping);
  FitSystem system;
  Triangle triangle(t + 1);
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    PressBlock block(problem, state, readings, p, parts);
    const PressRows& rows = problem.press_rows[p];
    const auto own = eigen_index(rows.columns);
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (rows.column[i] != no_column)
        block.matrix(block.filled + eigen_index(rows.column[i]), eigen_index(rows.column[i])) =
            root * columns.press_norm[p][i];
    block.eliminate();
    system.presses.push_back({block.matrix.topLeftCorner(own, own).triangularView<Eigen::Upper>(),
                              block.matrix.block(0, own, own, t),
                              block.matrix.topRightCorner(own, 1)});
    triangle.add(block.matrix.bottomRightCorner(block.matrix.rows() - own, t + 1));
  }
  if (!parts.common_priors) {
    triangle.add(
        problem.common_priors(state).bottomRows(eigen_index(problem.model().sites().size())));
  } else {
    const Eigen::MatrixXd stated = problem.common_priors(state);
    Eigen::MatrixXd priors = stated;
    priors.leftCols(eigen_index(problem.pad_columns())).setZero();
    FitRows(problem, state, readings, parts).add_pad_columns(stated, 0, priors);
    priors.col(t) = -priors.col(t);
    triangle.add(priors);
  }
  if (parts.damping > 0.0) {
    Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(t, t + 1);
    damping.diagonal() = root * columns.norm;
    triangle.add(damping);
  }
  const Eigen::MatrixXd all = triangle.take();
  system.triangle = all.topLeftCorner(t, t);
  system.rhs = all.topRightCorner(t, 1);
  return system;
}

PressPart press_part(const FitProblem& problem, const FitState& state,
                     const PressReadings& readings, std::size_t press) {
  const PressBlock block(problem, state, readings, press, {});
  const Eigen::Index own = eigen_index(problem.press_rows[press].columns);
  return {block.matrix.topLeftCorner(block.filled, own),
          block.matrix.block(0, own, block.filled, eigen_index(problem.columns()))};
}

FitStep fit_step(const FitProblem& problem, const FitState& state, const PressReadings& readings,
                 const SystemColumns& columns, const SystemParts& parts) {
  if (problem.readings_first())
    return step_of(reading_system(problem, state, readings, columns, parts), problem, parts);
  const FitSystem system = fit_system(problem, state, readings, columns, parts);
  FitStep step{solve_upper(system.triangle, system.rhs), {}};
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (parts.frozen[i])
      step.common(eigen_index(problem.pad_column(static_cast<PadParameter>(i)))) = 0.0;
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    step.presses.emplace_back();
    const auto& [own, share, rhs] = system.presses[p];
    if (own.size() == 0) continue;
    const Eigen::VectorXd x = solve_upper(own, rhs - share * step.common);
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (const std::size_t column = problem.press_rows[p].column[i]; column != no_column)
        step.presses.back()[i] = x(eigen_index(column));
  }
  return step;
}

}  // namespace tactile_net

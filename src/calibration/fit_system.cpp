#include "calibration/fit_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

/// Rows that are gathered before they are taken into the triangle: a blocked QR is fast on many.
constexpr Eigen::Index gathered_rows = 512;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// The rows of one press: its own columns, the common ones, the negative residual.
class PressBlock {
 public:
  PressBlock(const FitProblem& problem, const FitState& state, const PressReadings& readings,
             std::size_t p, const SystemParts& parts)
      : rows_(problem.press_rows[p]) {
    const std::size_t n = problem.model().sites().size();
    const std::vector<PressPrior> priors = problem.press_priors(state, p);
    const std::size_t own = rows_.columns;
    matrix.setZero(index(problem.readings_used() + priors.size() + own),
                   index(own + problem.columns() + 1));
    Eigen::Index row = 0;
    const Matrix* const own_parts[] = {&readings.by_log_force, &readings.by_center,
                                       &readings.by_log_half_width, &readings.by_friction};
    for (std::size_t j = 0; j < n; ++j) {
      if (!problem.used(j)) continue;
      const double root = std::sqrt(problem.weights[p * n + j]);
      const double scale = root * problem.gain(state, j) / problem.noise(j);
      for (std::size_t i = 0; i < press_unknowns; ++i)
        if (rows_.column[i] != no_column)
          matrix(row, index(rows_.column[i])) = scale * (*own_parts[i])(p, j);
      for (std::size_t i = 0; i < pad_parameter_count; ++i)
        add_pad(problem, row, i, scale * readings.by_pad[i](p, j), parts);
      if (const std::size_t gain = problem.gain_column(j); gain != no_column)
        matrix(row, index(own + gain)) = scale * readings.value(p, j);
      matrix(row, index(own + problem.offset_column(j))) = root;
      matrix(row, matrix.cols() - 1) = -root * problem.residual(state, readings, p, j);
      ++row;
    }
    for (const PressPrior& prior : priors) {
      if (prior.is_weak && !parts.weak_priors) continue;
      for (std::size_t i = 0; i < press_unknowns; ++i)
        if (rows_.column[i] != no_column) matrix(row, index(rows_.column[i])) = prior.by_press[i];
      for (std::size_t i = 0; i < pad_parameter_count; ++i)
        add_pad(problem, row, i, prior.by_pad[i], parts);
      matrix(row++, matrix.cols() - 1) = -prior.residual;
    }
    filled = row;
  }

  /// Householder's reflections of its own columns.
  void eliminate() {
    for (Eigen::Index c = 0; c < index(rows_.columns); ++c) {
      const Eigen::Index below = matrix.rows() - c;
      auto column = matrix.col(c).tail(below);
      const double length = column.norm();
      if (length == 0.0) continue;
      Eigen::VectorXd mirror = column;
      mirror(0) += mirror(0) < 0.0 ? -length : length;
      const double square = mirror.squaredNorm();
      auto rest = matrix.bottomRightCorner(below, matrix.cols() - c);
      const Eigen::RowVectorXd along = (2.0 / square) * (mirror.transpose() * rest);
      rest.noalias() -= mirror * along;
    }
  }

  Eigen::MatrixXd matrix{};
  Eigen::Index filled = 0;  ///< rows; those below are for damping

 private:
  void add_pad(const FitProblem& problem, Eigen::Index row, std::size_t parameter, double value,
               const SystemParts& parts) {
    auto which = static_cast<PadParameter>(parameter);
    if (which == PadParameter::thickness && parts.thickness_follows) which = PadParameter::depth;
    const std::size_t column = problem.pad_column(which);
    if (column != no_column && !parts.frozen[static_cast<std::size_t>(which)])
      matrix(row, index(rows_.columns + column)) += value;
  }

  const PressRows& rows_;
};

/// Rows [A | b] that became a triangle so far.
class Triangle {
 public:
  explicit Triangle(Eigen::Index columns)
      : stack_(Eigen::MatrixXd::Zero(columns + gathered_rows, columns)), top_(columns) {}

  void add(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
    for (Eigen::Index done = 0; done < rows.rows();) {
      const Eigen::Index part = std::min(rows.rows() - done, stack_.rows() - top_);
      stack_.middleRows(top_, part) = rows.middleRows(done, part);
      top_ += part;
      done += part;
      if (top_ == stack_.rows()) fold();
    }
  }
  [[nodiscard]] Eigen::MatrixXd take() {
    fold();
    return stack_.topRows(stack_.cols());
  }

 private:
  void fold() {
    const Eigen::Index columns = stack_.cols();
    const Eigen::MatrixXd r = HouseholderQr(Eigen::MatrixXd(stack_.topRows(top_))).triangle();
    stack_.setZero();
    stack_.topRows(columns) = r.triangularView<Eigen::Upper>();
    top_ = columns;
  }

  Eigen::MatrixXd stack_;
  Eigen::Index top_;
};

}  // namespace

SystemColumns system_columns(const FitProblem& problem, const FitState& state,
                             const PressReadings& readings) {
  const Eigen::Index t = index(problem.columns());
  SystemColumns result{Eigen::VectorXd::Zero(t), Eigen::VectorXd::Zero(t), {}};
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    const PressBlock block(problem, state, readings, p, {});
    const auto own = index(problem.press_rows[p].columns);
    const auto common = block.matrix.middleCols(own, t);
    result.norm += common.colwise().squaredNorm().transpose();
    result.gradient -= common.transpose() * block.matrix.rightCols(1);
    std::array<double, press_unknowns> norms{};
    for (std::size_t i = 0; i < press_unknowns; ++i) {
      const std::size_t column = problem.press_rows[p].column[i];
      norms[i] = column == no_column ? 0.0 : block.matrix.col(index(column)).norm();
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
  const Eigen::Index t = index(problem.columns());
  const double root = std::sqrt(parts.damping);
  FitSystem system;
  Triangle triangle(t + 1);
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    PressBlock block(problem, state, readings, p, parts);
    const PressRows& rows = problem.press_rows[p];
    const auto own = index(rows.columns);
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (rows.column[i] != no_column)
        block.matrix(block.filled + index(rows.column[i]), index(rows.column[i])) =
            root * columns.press_norm[p][i];
    block.eliminate();
    system.presses.push_back({block.matrix.topLeftCorner(own, own).triangularView<Eigen::Upper>(),
                              block.matrix.block(0, own, own, t),
                              block.matrix.topRightCorner(own, 1)});
    triangle.add(block.matrix.bottomRightCorner(block.matrix.rows() - own, t + 1));
  }
  if (!parts.common_priors) {
    triangle.add(problem.common_priors(state).bottomRows(index(problem.model().sites().size())));
  } else {
    Eigen::MatrixXd priors = problem.common_priors(state);
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (parts.frozen[i])
        priors.col(index(problem.pad_column(static_cast<PadParameter>(i)))).setZero();
    if (parts.thickness_follows) {
      const std::size_t from = problem.pad_column(PadParameter::thickness);
      const std::size_t to = problem.pad_column(PadParameter::depth);
      if (to != no_column && !parts.frozen[static_cast<std::size_t>(PadParameter::depth)])
        priors.col(index(to)) += priors.col(index(from));
      priors.col(index(from)).setZero();
    }
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

Eigen::MatrixXd eliminated_rows(const FitProblem& problem, const FitState& state,
                                const PressReadings& readings, std::size_t press) {
  PressBlock block(problem, state, readings, press, {});
  block.eliminate();
  const Eigen::Index own = index(problem.press_rows[press].columns);
  return block.matrix.bottomRows(block.matrix.rows() - own)
      .middleCols(own, index(problem.columns()));
}

std::array<double, press_unknowns> press_step(const FitSystem::Own& own, const PressRows& rows,
                                              const Eigen::VectorXd& common) {
  std::array<double, press_unknowns> step{};
  if (rows.columns == 0) return step;
  const Eigen::VectorXd x = solve_upper(own.own, own.rhs - own.share * common);
  for (std::size_t i = 0; i < press_unknowns; ++i)
    if (rows.column[i] != no_column) step[i] = x(index(rows.column[i]));
  return step;
}

}  // namespace tactile_net

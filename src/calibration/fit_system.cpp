#include "calibration/fit_system.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "calibration/triangle.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// The column of each unknown.
using UnknownPlaces = std::vector<Eigen::Index>;

/// The rows of one step's system, in whatever order it has its unknowns. Rows are zero before; the
/// negative residual stands last.
class FitRows {
 public:
  FitRows(const FitProblem& problem, const FitState& state, const PressReadings& readings,
          const SystemParts& parts)
      : problem_(problem), state_(state), readings_(readings), parts_(parts) {}

  /// Reading j of press p, over its noise.
  void put_reading(std::size_t p, std::size_t j, const UnknownPlaces& at, Eigen::MatrixXd& rows,
                   Eigen::Index row) const {
    const std::size_t n = problem_.model().sites().size();
    const double root = std::sqrt(problem_.weights[p * n + j]);
    const double scale = root * problem_.gain(state_, j) / problem_.noise(j);
    const Matrix* const by_press[] = {&readings_.by_log_force,      &readings_.by_center,
                                      &readings_.by_log_half_width, &readings_.by_friction,
                                      &readings_.by_center_z,       &readings_.by_friction_z};
    const PressRows& press = problem_.press_rows[p];
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (press.column[i] != no_column)
        rows(row, at[press.first + press.column[i]]) = scale * (*by_press[i])(p, j);
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (const std::size_t column = moved_column(i); column != no_column)
        rows(row, at[column]) += scale * readings_.by_pad[i](p, j);
    if (const std::size_t gain = problem_.gain_column(j); gain != no_column)
      rows(row, at[gain]) = scale * readings_.value(p, j);
    rows(row, at[problem_.offset_column(j)]) = root;
    rows(row, rows.cols() - 1) = -root * problem_.residual(state_, readings_, p, j);
  }

  /// What is stated of press p, from a row on; returns the row behind.
  Eigen::Index put_priors(std::size_t p, const UnknownPlaces& at, Eigen::MatrixXd& rows,
                          Eigen::Index row) const {
    const PressRows& press = problem_.press_rows[p];
    for (const PressPrior& prior : problem_.press_priors(state_, p)) {
      if (prior.is_weak && !parts_.weak_priors) continue;
      for (std::size_t i = 0; i < press_unknowns; ++i)
        if (press.column[i] != no_column)
          rows(row, at[press.first + press.column[i]]) = prior.by_press[i];
      for (std::size_t i = 0; i < pad_parameter_count; ++i)
        if (const std::size_t column = moved_column(i); column != no_column)
          rows(row, at[column]) += prior.by_pad[i];
      rows(row++, rows.cols() - 1) = -prior.residual;
    }
    return row;
  }

  /// All that one press says, as `put_priors`; at most `press_row_count` rows.
  Eigen::Index put_press(std::size_t p, const UnknownPlaces& at, Eigen::MatrixXd& rows) const {
    Eigen::Index row = 0;
    for (std::size_t j = 0; j < problem_.model().sites().size(); ++j)
      if (problem_.used(j)) put_reading(p, j, at, rows, row++);
    return put_priors(p, at, rows, row);
  }
  [[nodiscard]] Eigen::Index press_row_count() const {
    return eigen_index(problem_.readings_used() + most_press_priors);
  }

  /// Rows of the pad's parameters, or of all common unknowns, that end with their residual.
  [[nodiscard]] Eigen::MatrixXd placed(const Eigen::MatrixXd& stated, const UnknownPlaces& at,
                                       Eigen::Index width) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(stated.rows(), width);
    for (std::size_t i = 0; i < pad_parameter_count; ++i) {
      const std::size_t own = problem_.pad_column(static_cast<PadParameter>(i));
      const std::size_t to = moved_column(i);
      if (own != no_column && to != no_column) rows.col(at[to]) += stated.col(eigen_index(own));
    }
    for (std::size_t c = problem_.pad_columns(); eigen_index(c) + 1 < stated.cols(); ++c)
      rows.col(at[c]) = stated.col(eigen_index(c));
    rows.rightCols(1) = -stated.rightCols(1);
    return rows;
  }

 private:
  /// Where a pad parameter moves the common unknowns; no_column: it is held.
  [[nodiscard]] std::size_t moved_column(std::size_t parameter) const {
    auto which = static_cast<PadParameter>(parameter);
    if (which == PadParameter::thickness && parts_.thickness_follows) which = PadParameter::depth;
    return parts_.frozen[static_cast<std::size_t>(which)] ? no_column : problem_.pad_column(which);
  }

  const FitProblem& problem_;
  const FitState& state_;
  const PressReadings& readings_;
  const SystemParts& parts_;
};

/// The rows of one press: its own columns, the common ones, the negative residual.
Eigen::MatrixXd press_block(const FitRows& rows, const FitProblem& problem, std::size_t p) {
  const PressRows& press = problem.press_rows[p];
  const auto own = eigen_index(press.columns);
  UnknownPlaces at(problem.unknowns());
  std::iota(at.begin(), at.end(), own);
  std::iota(at.begin() + eigen_index(press.first), at.begin() + eigen_index(press.first) + own,
            Eigen::Index{0});
  Eigen::MatrixXd block =
      Eigen::MatrixXd::Zero(rows.press_row_count(), own + eigen_index(problem.columns()) + 1);
  const Eigen::Index filled = rows.put_press(p, at, block);
  return block.topRows(filled);
}

/// Groups are eliminated as they come; what they leave of the kept unknowns becomes a triangle.
class Elimination {
 public:
  Elimination(const FitProblem& problem, const FitState& state, const PressReadings& readings,
              const SystemColumns& columns, const SystemParts& parts)
      : problem_(problem),
        state_(state),
        rows_(problem, state, readings, parts),
        columns_(columns),
        parts_(parts),
        damping_(std::sqrt(parts.damping)) {}

  FitSystem presses_first() {
    result_.kept.resize(problem_.columns());
    std::iota(result_.kept.begin(), result_.kept.end(), std::size_t{0});
    Triangle triangle(kept() + 1);
    for (std::size_t p = 0; p < state_.presses.size(); ++p) {
      FitSystem::Group group;
      group.press = p;
      for (std::size_t i = 0; i < problem_.press_rows[p].columns; ++i)
        group.unknowns.push_back(problem_.press_rows[p].first + i);
      eliminate(std::move(group), rows_.press_row_count(), triangle,
                [&](const UnknownPlaces& at, Eigen::MatrixXd& rows) {
                  return rows_.put_press(p, at, rows);
                });
    }
    const Eigen::MatrixXd stated = problem_.common_priors(state_);
    const Eigen::Index offsets = eigen_index(problem_.model().sites().size());
    triangle.add(rows_.placed(parts_.common_priors ? stated : stated.bottomRows(offsets),
                              places({}), kept() + 1));
    return finish(triangle);
  }

  FitSystem readings_first() {
    keep_presses_and_pad();
    Triangle triangle(kept() + 1);
    for (const auto& [gain, members] : taxels()) eliminate_taxel(gain, members, triangle);
    for (std::size_t p = 0; p < state_.presses.size(); ++p) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(eigen_index(most_press_priors), kept() + 1);
      const Eigen::Index filled = rows_.put_priors(p, places({}), rows, 0);
      triangle.add(rows.topRows(filled));
    }
    if (parts_.common_priors) add_kept_priors(triangle);
    return finish(triangle);
  }

 private:
  [[nodiscard]] Eigen::Index kept() const { return eigen_index(result_.kept.size()); }

  /// Those to be eliminated first, then the kept ones; -1: in neither.
  [[nodiscard]] UnknownPlaces places(const std::vector<std::size_t>& own) const {
    UnknownPlaces at(problem_.unknowns(), -1);
    Eigen::Index next = 0;
    for (const std::size_t unknown : own) at[unknown] = next++;
    for (const std::size_t unknown : result_.kept) {
      if (unknown != no_column) at[unknown] = next;
      ++next;
    }
    return at;
  }

  /// @param fill  (places, rows): the group's rows, and how many they are
  template <class Fill>
  void eliminate(FitSystem::Group group, Eigen::Index most_rows, Triangle& triangle,
                 const Fill& fill) {
    const Eigen::Index own = eigen_index(group.unknowns.size());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(most_rows + own, own + kept() + 1);
    Eigen::Index row = fill(places(group.unknowns), rows);
    for (Eigen::Index i = 0; i < own; ++i)
      rows(row++, i) =
          damping_ * columns_.norm(eigen_index(group.unknowns[static_cast<std::size_t>(i)]));
    eliminate_columns(rows, own);
    group.own = rows.topLeftCorner(own, own).triangularView<Eigen::Upper>();
    group.share = rows.block(0, own, own, kept());
    group.rhs = rows.topRightCorner(own, 1);
    result_.groups.push_back(std::move(group));
    triangle.add(rows.block(own, own, row - own, kept() + 1));
  }

  FitSystem finish(Triangle& triangle) {
    if (parts_.damping > 0.0) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kept(), kept() + 1);
      for (Eigen::Index k = 0; k < kept(); ++k)
        if (const std::size_t unknown = result_.kept[static_cast<std::size_t>(k)];
            unknown != no_column)
          rows(k, k) = damping_ * columns_.norm(eigen_index(unknown));
      triangle.add(rows);
    }
    const Eigen::MatrixXd all = triangle.take();
    result_.triangle = all.topLeftCorner(kept(), kept());
    result_.rhs = all.topRightCorner(kept(), 1);
    return std::move(result_);
  }

  /// Kept are the unknowns of all presses, the pad's parameters, gains that are no taxel's own, and
  /// the means of those that are.
  void keep_presses_and_pad() {
    for (std::size_t i = problem_.columns(); i < problem_.unknowns(); ++i)
      result_.kept.push_back(i);
    for (std::size_t i = 0; i < problem_.pad_columns(); ++i) result_.kept.push_back(i);
    gains_are_local_ = problem_.gains_are_local();
    const FitProblem::GainPrior prior = problem_.gain_prior();
    has_prior_ = parts_.common_priors && std::isfinite(prior.sd);
    for (std::size_t g = 0; !gains_are_local_ && g < state_.log_gain.size(); ++g)
      result_.kept.push_back(problem_.pad_columns() + g);
    first_mean_ = kept();
    mean_of_.assign(state_.log_gain.size(), no_column);
    for (const std::vector<std::size_t>& block : problem_.gain_blocks()) {
      if (!gains_are_local_ || !has_prior_ || prior.mean_sd == 0.0 || block.empty()) continue;
      // The best mean of these gains: its own row and theirs balance.
      double sum = 0.0;
      for (const std::size_t gain : block) sum += state_.log_gain[gain];
      const double ratio = std::pow(prior.sd / prior.mean_sd, 2);
      means_.push_back(sum / (static_cast<double>(block.size()) + ratio));
      for (const std::size_t gain : block) mean_of_[gain] = means_.size() - 1;
      result_.kept.push_back(no_column);
    }
  }

  /// Readings by their gain; those without one, or with a kept one, each for itself.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::vector<std::size_t>>> taxels() const {
    std::map<std::size_t, std::vector<std::size_t>> by_gain;
    std::vector<std::pair<std::size_t, std::vector<std::size_t>>> all;
    for (std::size_t j = 0; j < problem_.model().sites().size(); ++j) {
      const std::size_t gain = problem_.gain_column(j);
      if (gains_are_local_ && gain != no_column)
        by_gain[gain].push_back(j);
      else
        all.push_back({no_column, {j}});
    }
    for (auto& [gain, members] : by_gain) all.emplace_back(gain, std::move(members));
    return all;
  }

  /// @param gain  of these readings, to be eliminated with their offsets; no_column: none is
  void eliminate_taxel(std::size_t gain, const std::vector<std::size_t>& members,
                       Triangle& triangle) {
    const std::size_t presses = state_.presses.size();
    FitSystem::Group group;
    if (gain != no_column) group.unknowns.push_back(gain);
    const std::size_t first_offset = group.unknowns.size();
    for (const std::size_t j : members)
      group.unknowns.push_back(problem_.columns() - problem_.model().sites().size() + j);
    const Eigen::Index own = eigen_index(group.unknowns.size());
    const auto put_taxel = [&](const UnknownPlaces& at, Eigen::MatrixXd& rows) {
      const Eigen::Index last = rows.cols() - 1;
      Eigen::Index row = 0;
      for (std::size_t m = 0; m < members.size(); ++m) {
        const std::size_t j = members[m];
        for (std::size_t p = 0; problem_.used(j) && p < presses; ++p)
          rows_.put_reading(p, j, at, rows, row++);
        const double frames = std::sqrt(static_cast<double>(problem_.log().unloaded.frames));
        rows(row, eigen_index(first_offset + m)) = frames;
        rows(row++, last) = -frames * state_.offset[j];
      }
      if (gain != no_column && has_prior_) {
        const std::size_t which = gain - problem_.pad_columns();
        const double sd = problem_.gain_prior().sd;
        const std::size_t mean = mean_of_[which];
        rows(row, 0) = 1.0 / sd;
        if (mean != no_column) rows(row, own + first_mean_ + eigen_index(mean)) = -1.0 / sd;
        rows(row++, last) =
            -(state_.log_gain[which] - (mean == no_column ? 0.0 : means_[mean])) / sd;
      }
      return row;
    };
    eliminate(std::move(group), eigen_index((presses + 1) * members.size() + 1), triangle,
              put_taxel);
  }

  void add_kept_priors(Triangle& triangle) const {
    const UnknownPlaces at = places({});
    triangle.add(rows_.placed(problem_.pad_priors(state_), at, kept() + 1));
    const auto add = [&](Eigen::Index column, double sd, double value) {
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, kept() + 1);
      row(0, column) = 1.0 / sd;
      row(0, kept()) = -value / sd;
      triangle.add(row);
    };
    const FitProblem::GainPrior prior = problem_.gain_prior();
    for (std::size_t m = 0; m < means_.size(); ++m)
      if (std::isfinite(prior.mean_sd)) add(first_mean_ + eigen_index(m), prior.mean_sd, means_[m]);
    for (std::size_t g = 0; !gains_are_local_ && has_prior_ && g < state_.log_gain.size(); ++g)
      add(at[problem_.pad_columns() + g], prior.sd, state_.log_gain[g]);
  }

  const FitProblem& problem_;
  const FitState& state_;
  FitRows rows_;
  const SystemColumns& columns_;
  const SystemParts& parts_;
  double damping_;
  bool gains_are_local_ = true, has_prior_ = false;
  Eigen::Index first_mean_ = 0;         // the kept column
  std::vector<double> means_{};         // of gains that share one
  std::vector<std::size_t> mean_of_{};  // each gain's
  FitSystem result_{};
};

}  // namespace

SystemColumns system_columns(const FitProblem& problem, const FitState& state,
                             const PressReadings& readings) {
  const Eigen::Index t = eigen_index(problem.columns());
  const SystemParts parts;
  const FitRows rows(problem, state, readings, parts);
  SystemColumns result{.norm = {},
                       .seen = Eigen::VectorXd::Zero(eigen_index(problem.unknowns())),
                       .gradient = Eigen::VectorXd::Zero(t)};
  for (std::size_t p = 0; p < state.presses.size(); ++p) {
    const Eigen::MatrixXd block = press_block(rows, problem, p);
    const PressRows& press = problem.press_rows[p];
    const auto own = eigen_index(press.columns);
    result.seen.segment(eigen_index(press.first), own) =
        block.leftCols(own).colwise().squaredNorm().transpose();
    const auto common = block.middleCols(own, t);
    result.seen.head(t) += common.colwise().squaredNorm().transpose();
    result.gradient -= common.transpose() * block.rightCols(1);
  }
  result.norm = result.seen;
  result.seen = result.seen.cwiseSqrt();
  const Eigen::MatrixXd priors = problem.common_priors(state);
  result.norm.head(t) += priors.leftCols(t).colwise().squaredNorm().transpose();
  result.gradient += priors.leftCols(t).transpose() * priors.rightCols(1);
  result.norm = result.norm.cwiseSqrt();
  for (double& norm : result.norm)
    if (norm == 0.0) norm = 1.0;
  return result;
}

FitSystem common_system(const FitProblem& problem, const FitState& state,
                        const PressReadings& readings, const SystemColumns& columns,
                        const SystemParts& parts) {
  return Elimination(problem, state, readings, columns, parts).presses_first();
}

FitSystem fit_system(const FitProblem& problem, const FitState& state,
                     const PressReadings& readings, const SystemColumns& columns,
                     const SystemParts& parts) {
  Elimination elimination(problem, state, readings, columns, parts);
  return problem.readings_first() ? elimination.readings_first() : elimination.presses_first();
}

PressPart press_part(const FitProblem& problem, const FitState& state,
                     const PressReadings& readings, std::size_t press) {
  const SystemParts parts;
  const Eigen::MatrixXd block =
      press_block(FitRows(problem, state, readings, parts), problem, press);
  const Eigen::Index own = eigen_index(problem.press_rows[press].columns);
  return {block.leftCols(own), block.middleCols(own, eigen_index(problem.columns()))};
}

FitStep fit_step(const FitProblem& problem, const FitState& state, const PressReadings& readings,
                 const SystemColumns& columns, const SystemParts& parts) {
  const FitSystem system = fit_system(problem, state, readings, columns, parts);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(eigen_index(problem.unknowns()));
  Eigen::VectorXd kept = solve_upper(system.triangle, system.rhs);
  for (std::size_t k = 0; k < system.kept.size(); ++k) {
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (parts.frozen[i] && system.kept[k] != no_column &&
          system.kept[k] == problem.pad_column(static_cast<PadParameter>(i)))
        kept(eigen_index(k)) = 0.0;
    if (system.kept[k] != no_column) step(eigen_index(system.kept[k])) = kept(eigen_index(k));
  }
  for (const FitSystem::Group& group : system.groups) {
    if (group.unknowns.empty()) continue;
    const Eigen::VectorXd x = solve_upper(group.own, group.rhs - group.share * kept);
    for (std::size_t i = 0; i < group.unknowns.size(); ++i)
      step(eigen_index(group.unknowns[i])) = x(eigen_index(i));
  }
  FitStep result{step.head(eigen_index(problem.columns())), {}};
  for (const PressRows& press : problem.press_rows) {
    result.presses.emplace_back();
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (press.column[i] != no_column)
        result.presses.back()[i] = step(eigen_index(press.first + press.column[i]));
  }
  return result;
}

}  // namespace tactile_net

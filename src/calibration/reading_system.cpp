#include "calibration/reading_system.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "calibration/triangle.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

class Assembly {
 public:
  Assembly(const FitProblem& problem, const FitState& state, const PressReadings& readings,
           const SystemColumns& columns, const SystemParts& parts)
      : problem_(problem),
        state_(state),
        rows_(problem, state, readings, parts),
        columns_(columns),
        parts_(parts),
        damping_(std::sqrt(parts.damping)) {
    count_kept();
  }

  ReadingSystem system() {
    Triangle triangle(eigen_index(kept_) + 1);
    for (const auto& [gain, members] : groups()) triangle.add(eliminated(gain, members));
    add_presses(triangle);
    if (parts_.common_priors) add_priors(triangle);
    if (parts_.damping > 0.0) add_damping(triangle);
    const Eigen::MatrixXd all = triangle.take();
    result_.triangle = all.topLeftCorner(eigen_index(kept_), eigen_index(kept_));
    result_.rhs = all.topRightCorner(eigen_index(kept_), 1);
    return std::move(result_);
  }

 private:
  void count_kept() {
    for (const PressRows& rows : problem_.press_rows) {
      result_.first_of_press.push_back(kept_);
      kept_ += rows.columns;
    }
    result_.first_common = kept_;
    for (std::size_t i = 0; i < problem_.pad_columns(); ++i) result_.common.push_back(i);
    gains_are_local_ = problem_.gains_are_local();
    for (const auto& block : problem_.gain_blocks())
      for (const std::size_t gain : block)
        if (!gains_are_local_) result_.common.push_back(problem_.pad_columns() + gain);
    const FitProblem::GainPrior prior = problem_.gain_prior();
    mean_of_.assign(state_.log_gain.size(), no_column);
    has_prior_ = parts_.common_priors && std::isfinite(prior.sd);
    for (const std::vector<std::size_t>& block : problem_.gain_blocks()) {
      if (!gains_are_local_ || !has_prior_ || prior.mean_sd == 0.0 || block.empty()) continue;
      // The best mean of these gains: its own row and theirs balance.
      double sum = 0.0;
      for (const std::size_t gain : block) sum += state_.log_gain[gain];
      const double ratio = std::pow(prior.sd / prior.mean_sd, 2);
      means_.push_back(sum / (static_cast<double>(block.size()) + ratio));
      for (const std::size_t gain : block) mean_of_[gain] = means_.size() - 1;
      result_.common.push_back(no_column);
    }
    kept_ += result_.common.size();
    first_mean_ = kept_ - means_.size();
  }

  [[nodiscard]] std::size_t kept_of(std::size_t common) const {
    // Pad parameters stand first in both; gains that are kept follow in the order of the blocks.
    if (common < problem_.pad_columns()) return result_.first_common + common;
    for (std::size_t i = problem_.pad_columns(); i < result_.common.size(); ++i)
      if (result_.common[i] == common) return result_.first_common + i;
    return no_column;
  }

  /// Readings by their gain; those without one, or with a kept one, each for itself.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::vector<std::size_t>>> groups() const {
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

  /// The group's rows without what is its own, which goes to the result.
  Eigen::MatrixXd eliminated(std::size_t gain, const std::vector<std::size_t>& members) {
    const std::size_t presses = state_.presses.size();
    ReadingSystem::Group group;
    if (gain != no_column) group.columns.push_back(gain);
    const std::size_t first_offset = group.columns.size();
    for (const std::size_t j : members)
      group.columns.push_back(problem_.columns() - problem_.model().sites().size() + j);
    const std::size_t own = group.columns.size();
    Eigen::MatrixXd rows =
        Eigen::MatrixXd::Zero(eigen_index(presses * members.size() + 1 + members.size() + own),
                              eigen_index(own + kept_ + 1));
    const Eigen::Index last = rows.cols() - 1;
    Eigen::Index row = 0;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const std::size_t j = members[m];
      for (std::size_t p = 0; problem_.used(j) && p < presses; ++p) {
        RowPlaces at = places_of(p, own);
        if (const std::size_t one = problem_.gain_column(j); one != no_column)
          at.gain = gains_are_local_ ? 0 : own + kept_of(one);
        at.offset = first_offset + m;
        rows_.put_reading(p, j, at, rows, row++);
      }
      const double frames = std::sqrt(static_cast<double>(problem_.log().unloaded.frames));
      rows(row, eigen_index(first_offset + m)) = frames;
      rows(row++, last) = -frames * state_.offset[j];
    }
    if (gain != no_column && has_prior_) {
      const std::size_t which = gain - problem_.pad_columns();
      const double sd = problem_.gain_prior().sd;
      const std::size_t mean = mean_of_[which];
      rows(row, 0) = 1.0 / sd;
      if (mean != no_column) rows(row, eigen_index(own + first_mean_ + mean)) = -1.0 / sd;
      rows(row++, last) = -(state_.log_gain[which] - (mean == no_column ? 0.0 : means_[mean])) / sd;
    }
    for (std::size_t i = 0; i < own && parts_.damping > 0.0; ++i)
      rows(row++, eigen_index(i)) = damping_ * columns_.norm(eigen_index(group.columns[i]));
    eliminate_columns(rows, eigen_index(own));
    group.own =
        rows.topLeftCorner(eigen_index(own), eigen_index(own)).triangularView<Eigen::Upper>();
    group.share = rows.block(0, eigen_index(own), eigen_index(own), eigen_index(kept_));
    group.rhs = rows.topRightCorner(eigen_index(own), 1);
    result_.groups.push_back(std::move(group));
    return rows.block(eigen_index(own), eigen_index(own), row - eigen_index(own),
                      eigen_index(kept_) + 1);
  }

  /// Of a row that speaks of press p.
  ///
  /// @param own  unknowns that are to be eliminated: they stand before all others
  [[nodiscard]] RowPlaces places_of(std::size_t p, std::size_t own) const {
    return {.press = own + result_.first_of_press[p], .pad = own + result_.first_common};
  }

  /// What is stated of the presses.
  void add_presses(Triangle& triangle) const {
    for (std::size_t p = 0; p < state_.presses.size(); ++p)
      for (const PressPrior& prior : problem_.press_priors(state_, p)) {
        if (prior.is_weak && !parts_.weak_priors) continue;
        Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, eigen_index(kept_) + 1);
        rows_.put_prior(p, prior, places_of(p, 0), row, 0);
        triangle.add(row);
      }
  }

  void add_priors(Triangle& triangle) const {
    const Eigen::MatrixXd pad = problem_.pad_priors(state_);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(pad.rows(), eigen_index(kept_) + 1);
    rows_.add_pad_columns(pad, result_.first_common, rows);
    rows.rightCols(1) = -pad.rightCols(1);
    triangle.add(rows);
    const auto add = [&](std::size_t column, double sd, double value) {
      Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, eigen_index(kept_) + 1);
      row(0, eigen_index(column)) = 1.0 / sd;
      row(0, eigen_index(kept_)) = -value / sd;
      triangle.add(row);
    };
    const FitProblem::GainPrior prior = problem_.gain_prior();
    for (std::size_t m = 0; m < means_.size(); ++m)
      if (std::isfinite(prior.mean_sd)) add(first_mean_ + m, prior.mean_sd, means_[m]);
    for (std::size_t g = 0; !gains_are_local_ && has_prior_ && g < state_.log_gain.size(); ++g)
      add(kept_of(problem_.pad_columns() + g), prior.sd, state_.log_gain[g]);
  }

  void add_damping(Triangle& triangle) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(eigen_index(kept_), eigen_index(kept_) + 1);
    for (std::size_t p = 0; p < state_.presses.size(); ++p)
      for (std::size_t i = 0; i < press_unknowns; ++i)
        if (const std::size_t column = problem_.press_rows[p].column[i]; column != no_column) {
          const Eigen::Index at = eigen_index(result_.first_of_press[p] + column);
          rows(at, at) = damping_ * columns_.press_norm[p][i];
        }
    for (std::size_t i = 0; i < result_.common.size(); ++i)
      if (result_.common[i] != no_column) {
        const Eigen::Index at = eigen_index(result_.first_common + i);
        rows(at, at) = damping_ * columns_.norm(eigen_index(result_.common[i]));
      }
    triangle.add(rows);
  }

  const FitProblem& problem_;
  const FitState& state_;
  FitRows rows_;
  const SystemColumns& columns_;
  const SystemParts& parts_;
  double damping_;
  bool gains_are_local_ = true, has_prior_ = false;
  std::size_t kept_ = 0, first_mean_ = 0;
  std::vector<double> means_{};         // of gains that share one
  std::vector<std::size_t> mean_of_{};  // each gain's
  ReadingSystem result_{};
};

}  // namespace

ReadingSystem reading_system(const FitProblem& problem, const FitState& state,
                             const PressReadings& readings, const SystemColumns& columns,
                             const SystemParts& parts) {
  return Assembly(problem, state, readings, columns, parts).system();
}

FitStep step_of(const ReadingSystem& system, const FitProblem& problem, const SystemParts& parts) {
  Eigen::VectorXd kept = solve_upper(system.triangle, system.rhs);
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (const std::size_t column = problem.pad_column(static_cast<PadParameter>(i));
        parts.frozen[i] && column != no_column)
      kept(eigen_index(system.first_common + column)) = 0.0;
  FitStep step{Eigen::VectorXd::Zero(eigen_index(problem.columns())), {}};
  for (std::size_t i = 0; i < system.common.size(); ++i)
    if (system.common[i] != no_column)
      step.common(eigen_index(system.common[i])) = kept(eigen_index(system.first_common + i));
  for (const ReadingSystem::Group& group : system.groups) {
    const Eigen::VectorXd x = solve_upper(group.own, group.rhs - group.share * kept);
    for (std::size_t i = 0; i < group.columns.size(); ++i)
      step.common(eigen_index(group.columns[i])) = x(eigen_index(i));
  }
  for (std::size_t p = 0; p < problem.press_rows.size(); ++p) {
    step.presses.emplace_back();
    for (std::size_t i = 0; i < press_unknowns; ++i)
      if (const std::size_t column = problem.press_rows[p].column[i]; column != no_column)
        step.presses.back()[i] = kept(eigen_index(system.first_of_press[p] + column));
  }
  return step;
}

}  // namespace tactile_net

/// @file
/// The linear system of one step: what belongs to single presses, or where readings are many to
/// single taxels, is eliminated group by group; the rest is a triangle. Private.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibration/fit_problem.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// What enters beside the rows of the readings and of what is stated of presses.
struct SystemParts {
  double damping = 0.0;            ///< Levenberg's, of columns scaled to unit length
  bool common_priors = true;       ///< else of the offsets alone: unloaded frames are measured
  bool weak_priors = true;         ///< of widths that nobody stated
  bool thickness_follows = false;  ///< at its bound: it moves with the depth
  /// Pad parameters at the end of their range, or held for a profile.
  std::array<bool, pad_parameter_count> frozen{};
};

/// Lengths of the columns of all unknowns, and the slope of the objective by the common ones.
struct SystemColumns {
  Eigen::VectorXd norm;  ///< with priors; 1 where it is 0
  Eigen::VectorXd seen;  ///< without priors of the common unknowns
  Eigen::VectorXd gradient;
};
[[nodiscard]] SystemColumns system_columns(const FitProblem& problem, const FitState& state,
                                           const PressReadings& readings);

/// Unknowns are numbered with the common ones first, then each press' (`PressRows::first`).
struct FitSystem {
  /// own x = rhs - share * kept.
  struct Group {
    std::size_t press = no_column;        ///< whose unknowns they are; no_column: a taxel's
    std::vector<std::size_t> unknowns{};  ///< of a taxel: its gain, if it has one, and offsets
    Eigen::MatrixXd own, share;
    Eigen::VectorXd rhs;
  };
  std::vector<Group> groups{};
  std::vector<std::size_t> kept{};  ///< of each column of the triangle; no_column: a mean of gains
  Eigen::MatrixXd triangle;         ///< triangle kept = rhs
  Eigen::VectorXd rhs;
};

/// Presses are eliminated one by one: the triangle is that of the common unknowns.
[[nodiscard]] FitSystem common_system(const FitProblem& problem, const FitState& state,
                                      const PressReadings& readings, const SystemColumns& columns,
                                      const SystemParts& parts);

/// The same system in the cheaper order. Where readings are many (`FitProblem::readings_first`)
/// each gain with the offsets of its readings goes first; then a gain's prior ties it to the others
/// of its channel through their mean, which is an unknown here: gain ~ N(mean, gain_sd),
/// mean ~ N(0, mean_gain_sd) is what `FitProblem::common_priors` says. Without
/// `SystemParts::common_priors` gains have none, and no means.
[[nodiscard]] FitSystem fit_system(const FitProblem& problem, const FitState& state,
                                   const PressReadings& readings, const SystemColumns& columns,
                                   const SystemParts& parts);

/// What one press says of its own unknowns and of the common ones: a row for each reading and for
/// what is stated of it, noise 1.
struct PressPart {
  Eigen::MatrixXd own, common;
};
[[nodiscard]] PressPart press_part(const FitProblem& problem, const FitState& state,
                                   const PressReadings& readings, std::size_t press);

/// A step of everything that is fitted.
struct FitStep {
  Eigen::VectorXd common;
  std::vector<std::array<double, press_unknowns>> presses{};  ///< zeros where they are exact
};
/// Levenberg's and Marquardt's, by `fit_system`.
[[nodiscard]] FitStep fit_step(const FitProblem& problem, const FitState& state,
                               const PressReadings& readings, const SystemColumns& columns,
                               const SystemParts& parts);

}  // namespace tactile_net

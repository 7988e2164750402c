/// @file
/// The linear system of one step of a sensor with many readings: what belongs to one taxel is
/// eliminated taxel by taxel, the rest is a triangle. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/fit_problem.hpp"
#include "calibration/fit_system.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// `FitSystem` with the other order: each gain with the offsets of its readings first. A gain's
/// prior ties it to the others of its channel through their mean, which is an unknown here:
/// gain ~ N(mean, gain_sd), mean ~ N(0, mean_gain_sd) is what `FitProblem::common_priors` says.
///
/// Kept are the unknowns of all presses, the pad's parameters, gains that are no taxel's own, and
/// the means.
struct ReadingSystem {
  /// own x = rhs - share * kept, for a gain and its readings' offsets.
  struct Group {
    std::vector<std::size_t> columns{};  ///< of the common unknowns
    Eigen::MatrixXd own, share;
    Eigen::VectorXd rhs;
  };
  std::vector<Group> groups{};
  Eigen::MatrixXd triangle;
  Eigen::VectorXd rhs;
  std::vector<std::size_t> first_of_press{};  ///< kept columns; and behind them
  std::size_t first_common = 0;
  std::vector<std::size_t> common{};  ///< of each kept column from there on its common unknown;
                                      ///< no_column: a mean
};
/// @param parts  without `common_priors` gains have none, and no means
[[nodiscard]] ReadingSystem reading_system(const FitProblem& problem, const FitState& state,
                                           const PressReadings& readings,
                                           const SystemColumns& columns, const SystemParts& parts);

[[nodiscard]] FitStep step_of(const ReadingSystem& system, const FitProblem& problem,
                              const SystemParts& parts);

}  // namespace tactile_net

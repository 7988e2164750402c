/// @file
/// The linear system of one step: presses eliminated one by one, the rest a triangle. Private.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibration/fit_problem.hpp"
#include "calibration/fit_rows.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// Lengths of the columns, and the slope of the objective.
struct SystemColumns {
  Eigen::VectorXd norm, gradient;
  Eigen::VectorXd seen;  ///< lengths without priors
  std::vector<std::array<double, press_unknowns>> press_norm{};
};
[[nodiscard]] SystemColumns system_columns(const FitProblem& problem, const FitState& state,
                                           const PressReadings& readings);

/// The factors: R x = rhs for the common unknowns, and of each press' own
/// own x = rhs - share * common.
struct FitSystem {
  struct Own {
    Eigen::MatrixXd own, share;
    Eigen::VectorXd rhs;
  };
  Eigen::MatrixXd triangle;
  Eigen::VectorXd rhs;
  std::vector<Own> presses{};
};
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
/// Of Levenberg and Marquardt, through `FitSystem` or, where readings are many, `ReadingSystem`.
[[nodiscard]] FitStep fit_step(const FitProblem& problem, const FitState& state,
                               const PressReadings& readings, const SystemColumns& columns,
                               const SystemParts& parts);

}  // namespace tactile_net

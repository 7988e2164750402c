/// @file
/// What is known of everything that was fitted, at a minimum. Private.
#pragma once

#include <vector>

#include "calibration/fit_system.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// Of the common unknowns; what is not known at all has an infinite variance, and no part in the
/// others'.
struct FitCovariance {
  Eigen::MatrixXd matrix;
  std::vector<bool> unknown;
  double rank = 0.0;

  /// Of one press' unknowns, and with the common ones. `regular`: all of them are known.
  struct Press {
    Eigen::MatrixXd own, cross;
    bool regular = true;
  };
  std::vector<Press> presses{};

  /// The sum of l' C l over the rows l of common unknowns.
  [[nodiscard]] double leverage(const Eigen::MatrixXd& rows) const;

  /// matrix = root root' + own own', own with one block a taxel where these were eliminated.
  Eigen::MatrixXd root{};
  struct Block {
    std::vector<std::size_t> columns{};
    Eigen::MatrixXd root;
  };
  std::vector<Block> blocks{};
};

[[nodiscard]] FitCovariance fit_covariance(const FitProblem& problem, const FitState& state,
                                           const PressReadings& readings,
                                           const SystemColumns& columns, const SystemParts& parts);

}  // namespace tactile_net

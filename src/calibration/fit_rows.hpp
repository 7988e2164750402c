/// @file
/// The rows of one step's system: of a reading, of what is stated of a press and of the pad, in
/// whatever order a system has its unknowns. Private.
#pragma once

#include <array>
#include <cstddef>

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

/// Where a pad parameter moves the common unknowns; no_column: it is held.
[[nodiscard]] std::size_t moved_column(const FitProblem& problem, std::size_t parameter,
                                       const SystemParts& parts);

/// Where a system has the unknowns that one row speaks of. The negative residual stands last.
struct RowPlaces {
  std::size_t press = 0;           ///< the first of the press' own
  std::size_t pad = 0;             ///< the first of the pad's parameters
  std::size_t gain = no_column;    ///< the reading's gain; no_column: it has none
  std::size_t offset = no_column;  ///< the reading's; no row of a reading is without
};

class FitRows {
 public:
  FitRows(const FitProblem& problem, const FitState& state, const PressReadings& readings,
          const SystemParts& parts)
      : problem_(problem), state_(state), readings_(readings), parts_(parts) {}

  /// Reading j of press p, over its noise. The row is zero before.
  void put_reading(std::size_t p, std::size_t j, const RowPlaces& at, Eigen::MatrixXd& rows,
                   Eigen::Index row) const;
  void put_prior(std::size_t p, const PressPrior& prior, const RowPlaces& at, Eigen::MatrixXd& rows,
                 Eigen::Index row) const;
  /// Columns of the pad's parameters, as `FitProblem::pad_column` has them, to where they move.
  ///
  /// @param pad  the first of them in `rows`
  void add_pad_columns(const Eigen::MatrixXd& from, std::size_t pad, Eigen::MatrixXd& rows) const;

 private:
  const FitProblem& problem_;
  const FitState& state_;
  const PressReadings& readings_;
  const SystemParts& parts_;
};

}  // namespace tactile_net

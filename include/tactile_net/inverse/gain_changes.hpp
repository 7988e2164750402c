/// @file
/// Which gains are no longer what a calibration says, from frames under loads that nobody knows.
///
/// A contact presses: its readings lie in a convex cone, whatever its shape (data_verdict.hpp). A
/// gain that changed takes them out of it. With the cone's columns C and z >= 0, the changes d of
/// gains and b of offsets are the penalised maximum likelihood of
///
///     g_t = (1 + d) (C z_t) + b + noise
///
/// Nothing smooths z: a sound array's frames leave noise, or less. So there is no bias to be taken
/// for a change. All gains lie some `spread` about what the calibration says, which is what the
/// frames make likeliest, and a few may have changed by more. Those are named where
///
/// - what the frames say of d lies 3.5 standard deviations from zero, the spread's among them, and
///   d is over 2 %;
/// - either half of the frames says the same of it, by 1.5 standard deviations;
/// - the frames are explained to their noise then: else not gains are wrong, but the pad.
///
/// What all gains, or those of many neighbours, do together is no different from other loads, and
/// taxels further apart than their depth do not tell each other's gains: nothing is named then.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

struct GainChange {
  std::size_t reading = 0;
  double change = 0.0;  ///< relative: -0.03 reads 3 % less than calibrated
  double sd = 0.0;      ///< standard deviation of `change`
};

struct GainChanges {
  std::size_t frames = 0;           ///< under load
  double rms = 0.0;                 ///< residual of the best contacts, over the noise
  std::vector<GainChange> named{};  ///< the changed gains, those that explain most first
};

/// Readings to find changed gains in: each a mean of frames in one state, without missing numbers.
struct GainFrames {
  std::vector<double> noise{};               ///< rms of each reading; 0: it does not count
  std::vector<std::vector<double>> loads{};  ///< readings under load, with that noise
  std::vector<double> rest{};                ///< mean of `resting` frames without load, or none
  std::size_t resting = 0;
};

/// Finds the gains that changed. O(frames x (readings x columns + readings^3)). Names none from
/// fewer than 8 loads.
///
/// @param contacts        on a surface fine enough for narrow contacts, and beyond the array's
///                        ends; not weighted, with two unknowns. Its first rows are the readings,
///                        others do not count
/// @param friction_limit  |f_t| / f_v of what touches the pad, at most, > 0
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] GainChanges gain_changes(const LinearProblem& contacts, double friction_limit,
                                       const GainFrames& given);

}  // namespace tactile_net

/// @file
/// What the numbers of a recording mean: from counts to readings, and back.
///
///     calibrate(*scene.calibration, frame);  // raw numbers before, readings in SI after
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tactile_net {

/// Frames of a recording, from 0, both included: `first` <= `last`.
struct FrameRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// reading = gain (raw - baseline) + offset, for each reading, channel after channel.
struct Calibration {
  std::vector<double> gain{};      ///< unit of the reading per unit of the raw number, not 0
  std::vector<double> baseline{};  ///< raw number without contact
  std::vector<double> offset{};    ///< [unit of the reading]
  /// Frames whose mean becomes the baseline, reading by reading; `baseline` is 0 until they are
  /// read.
  std::optional<FrameRange> baseline_frames{};
  std::vector<double> missing{};  ///< raw numbers that stand for a value that is missing: 65535
};

/// True if a raw number is a code for a missing value.
[[nodiscard]] bool is_missing(const Calibration& calibration, double number) noexcept;

/// @throw std::invalid_argument  not so many values of each kind, one is not finite, a gain is 0
void check(const Calibration& calibration, std::size_t readings);

/// Raw numbers to readings, in place; NaN stays NaN, and codes for missing values become it.
///
/// @pre  the calibration has one value of each kind per number
void calibrate(const Calibration& calibration, std::span<double> numbers) noexcept;

/// Readings to raw numbers, in place: undoes `calibrate` but for rounding.
void uncalibrate(const Calibration& calibration, std::span<double> numbers) noexcept;

}  // namespace tactile_net

/// @file
/// What a recording holds when nothing moves: its noise, and the least loaded
/// state that comes back. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sensing/frame_triples.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

struct StillNoise {
  std::vector<const FrameTriple*> still{};  ///< in which no more than noise changes
  std::vector<double> of_reading{};         ///< rms; none: too few still triples
  std::vector<double> of_channel{};         ///< the median of its readings
  /// By how much a reading of the channel changes by nothing but noise and a converter's steps.
  std::vector<double> least_change{};
  std::vector<double> scale{};  ///< that, of every reading
  std::vector<double> steps{};  ///< a converter's, per channel; 0: none can be seen

  [[nodiscard]] bool known() const noexcept { return !of_reading.empty(); }
};

/// White noise, by what is left of three frames where a straight line is taken
/// off.
///
/// @param living  per reading: false for those that do not count
/// @param steps   a converter's, per channel; 0: none can be seen
[[nodiscard]] StillNoise still_noise(std::span<const FrameTriple> triples,
                                     const std::vector<bool>& living,
                                     std::span<const Channel> channels,
                                     std::span<const double> steps);

/// Frames that are alike, within noise.
struct Rest {
  std::vector<double> values{};        ///< their median, 0 for readings that do not count
  std::vector<std::size_t> triples{};  ///< indices of those whose middle frame is one of them

  [[nodiscard]] bool known() const noexcept { return !triples.empty(); }
};

/// The least loaded frames that are alike, at least five.
///
/// @param triples  still ones
[[nodiscard]] Rest find_rest(std::span<const FrameTriple* const> triples,
                             const std::vector<bool>& living, const StillNoise& noise);

/// How far two frames are apart, in units of `scale`: about 1.4 for two of the same state, where
/// that is the noise. Of no second frame: how far the first is from zero.
[[nodiscard]] double frame_distance(std::span<const double> a, std::span<const double> b,
                                    const std::vector<bool>& living,
                                    const std::vector<double>& scale);

}  // namespace tactile_net::lab

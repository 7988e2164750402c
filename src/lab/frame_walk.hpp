/// @file
/// From frame to frame of a simulated sensor, a line or a skin, through its signal path. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/sensing/signal_path.hpp"

namespace tactile_net::lab {

/// Where a recording is.
struct FrameWalk {
  const std::vector<Instant>& instants;
  std::size_t& next;  ///< of the instants
  SignalPath& path;
  std::vector<double>& readings;
  double& time;  ///< of the frame last taken [s]

  /// Goes on to the next frame; false if there is none.
  ///
  /// @param wanted  false: the readings hold nothing of use
  /// @param load    of a time: makes `readings` those of the pad alone
  /// @param count   how many readings there are
  [[nodiscard]] bool go_on(bool wanted, std::size_t count, const auto& load) {
    for (; next < instants.size(); ++next) {
      const Instant& at = instants[next];
      if (wanted || path.has_memory())
        load(at.time);
      else
        readings.assign(count, 0.0);
      path.apply(at, readings);
      if (!at.recorded) continue;
      time = at.time;
      ++next;
      return true;
    }
    return false;
  }
};

}  // namespace tactile_net::lab

/// @file
/// Signals through a scene's effects.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tactile_net/scene/reader.hpp"

namespace tactile_net::test {

/// The frames of a signal that is `of(t, reading)` before the effects.
std::vector<std::vector<double>> signal_frames(const auto& scene, auto of) {
  SignalPath path = signal_path(scene);
  std::vector<std::vector<double>> result;
  for (const Instant& at : instants(scene)) {
    std::vector<double> readings;
    for (std::size_t i = 0; i < reading_count(scene.sensor); ++i)
      readings.push_back(of(at.time, i));
    path.apply(at, readings);
    if (at.recorded) result.push_back(readings);
  }
  return result;
}

/// A signal that moves, with zeros of either sign in it.
inline double moving(double t, std::size_t i) {
  return i == 3 ? -0.0 : i == 4 ? 0.0 : std::sin(t + static_cast<double>(i));
}

inline std::vector<std::uint64_t> bits(const std::vector<std::vector<double>>& frames) {
  std::vector<std::uint64_t> all;
  for (const auto& frame : frames)
    for (const double value : frame) all.push_back(std::bit_cast<std::uint64_t>(value));
  return all;
}

}  // namespace tactile_net::test

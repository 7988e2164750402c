/// @file
/// A skin's recording as numbers.
#pragma once

#include <vector>

#include "tactile_net/lab/skin_simulation.hpp"

namespace tactile_net {

/// What a skin's sensor reads of each frame of its scene.
inline std::vector<std::vector<double>> frames_of(const SkinScene& scene) {
  std::vector<std::vector<double>> all;
  lab::SkinRecording recording(scene);
  while (recording.next())
    all.emplace_back(recording.readings().begin(), recording.readings().end());
  return all;
}

}  // namespace tactile_net

/// @file
/// What came of a recording as a whole, frame after frame.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/simulated_frame.hpp"

namespace tactile_net::lab {

/// What a method made of recorded frames.
struct SolvedFrames {
  std::size_t frames = 0;
  std::map<Verdict, std::size_t> verdicts{};  ///< how many frames have it
  FrameResult last{};                         ///< of the last frame

  void add(const FrameResult& result);
};

/// What a scene's sensor recorded.
struct RecordedFrames {
  std::size_t frames = 0;
  /// In how many frames an effect cut readings off, by its name.
  std::map<std::string, std::size_t, std::less<>> cut_off{};

  /// Counts the frame that the recording has just taken.
  void add(const SensorRecording& recording);
};

}  // namespace tactile_net::lab

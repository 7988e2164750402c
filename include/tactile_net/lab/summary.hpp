/// @file
/// What came of a recording as a whole, frame after frame.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/frame_runs.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"

namespace tactile_net::lab {

/// What a method made of recorded frames.
struct SolvedFrames {
  std::size_t frames = 0;
  std::map<Verdict, std::size_t> verdicts{};        ///< how many frames have it
  std::map<Verdict, FrameRuns> distrusted{};        ///< and which, of all that are faults
  std::map<DataDoubt, FrameRuns> doubted{};         ///< which frames' readings are, and why
  std::map<std::size_t, std::size_t> bad_taxels{};  ///< in how many frames, by the taxel
  bool noise_known = false;                         ///< else nobody asks for a misfit
  FrameRuns skipped{};       ///< frames without an answer: readings are missing
  FrameRuns estimated{};     ///< frames solved without the taxels they miss
  double least_alpha = 0.0;  ///< of those that a rule chose; 0: none did
  double largest_alpha = 0.0;
  std::optional<double> least_weight{};  ///< of the tangential ones that were estimated
  std::optional<double> largest_weight{};
  /// Of the frame that presses hardest on a curved skin which is taken for flat.
  std::optional<remark::FlatKernel> flat_kernel{};
  double flat_force = 0.0;  ///< of that frame [N]
  struct Last {
    ChosenAlpha alpha{};
    std::optional<Condition> condition{};
    Remarks remarks{};
  };
  Last last{};  ///< of the last frame that was solved

  /// Of the next frame. @param incomplete  it was solved without the taxels it misses
  void add(const FrameAnswer& answer, bool incomplete = false);
  /// The next frame has no answer.
  void skip();
};

/// What a scene's sensor recorded.
struct RecordedFrames {
  std::size_t frames = 0;
  /// In how many frames an effect cut readings off, by its name.
  std::map<std::string, std::size_t, std::less<>> cut_off{};

  /// Counts the frame that the recording has just taken.
  void add(const SensorRecording& recording) { add(recording.notes()); }
  void add(const SkinRecording& recording) { add(recording.notes()); }

 private:
  void add(const std::vector<CutOffNote>& notes);
};

}  // namespace tactile_net::lab

/// @file
/// Recordings of sound sensors, of many kinds and by their seeds, in which tests plant faults.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <variant>

#include "tactile_net/lab/readings_check.hpp"
#include "tests/lab/checked_recording.hpp"

namespace tactile_net {

enum class Course { pressed, held, lasting, sliding, swaying, idle };
enum class Chain { noise, fine_steps, coarse_steps, threshold };

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double white(double rms) { return rms * std::normal_distribution<double>()(engine_); }
  template <typename Value>
  Value one_of(std::initializer_list<Value> values) {
    return values
        .begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(engine_)];
  }

 private:
  std::mt19937_64 engine_;
};

/// What a recording is of. What is left out, or empty, is chosen at random.
struct RecordingKind {
  std::optional<Course> course{};
  std::optional<Chain> chain{};
  std::optional<double> pitch_in_depths{};
  std::string reads{};
  double least_peak = 40.0;  // the largest reading, about, over the noise
};

constexpr std::size_t frames_recorded = 160;  // 1.6 s

RecordedLine honest_line(std::uint64_t seed, const RecordingKind& kind = {});
RecordedSkin honest_skin(std::uint64_t seed, const RecordingKind& kind = {});

/// The one whose first channel reads most.
template <typename Scene>
std::size_t taxel_in_the_middle(const CheckedRecording<Scene>& recording) {
  const std::size_t channels = channel_count(recording.scene.sensor);
  std::size_t most = 0;
  double largest = 0.0;
  for (const auto& frame : recording.frames)
    for (std::size_t i = 0; i < frame.size() / channels; ++i)
      if (frame[i] > largest) {
        largest = frame[i];
        most = i;
      }
  return most;
}

/// A check's first finding of a kind, if there is one.
template <class Found>
std::optional<Found> found_in(const lab::ReadingsCheck& check) {
  for (const lab::Finding& one : check.findings)
    if (const Found* found = std::get_if<Found>(&one)) return *found;
  return std::nullopt;
}

}  // namespace tactile_net

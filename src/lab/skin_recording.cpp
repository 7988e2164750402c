#include "tactile_net/lab/skin_recording.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tactile_net::lab {
namespace {

constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

std::size_t most_frames(std::size_t values) {
  return std::clamp(SkinRecordingAnswer::most_values / std::max<std::size_t>(values, 1),
                    SkinRecordingAnswer::least_shown, SkinRecordingAnswer::most_shown);
}

void show(SkinRecordingAnswer& recording, std::span<const double> frame_readings,
          const FrameAnswer& found) {
  const auto& frames = recording.frames;
  auto& shown = recording.shown;
  std::size_t& per_shown = recording.per_shown;
  const auto harder = [&](std::size_t a, std::size_t b) {
    return frames[a].wrench.normal.value > frames[b].wrench.normal.value;
  };
  const std::size_t frame = frames.size() - 1;
  const auto shown_frame = [&](std::size_t count) {
    return SkinRecordingAnswer::Shown{.frame = frame,
                                      .count = count,
                                      .tractions = found.tractions,
                                      .deviations = found.deviations,
                                      .readings = {frame_readings.begin(), frame_readings.end()},
                                      .cells = found.cells};
  };
  if (shown.empty() || shown.back().count == per_shown) {
    shown.push_back(shown_frame(1));
  } else {
    const std::size_t count = shown.back().count + 1;
    if (harder(frame, shown.back().frame)) shown.back() = shown_frame(count);
    shown.back().count = count;
  }
  const std::size_t values = found.tractions.size() + frame_readings.size() +
                             (found.deviations.empty() ? 0 : recording.grid.count());
  if (shown.size() <= most_frames(values)) return;
  std::vector<SkinRecordingAnswer::Shown> merged;
  for (std::size_t i = 0; i + 1 < shown.size(); i += 2) {
    const std::size_t count = shown[i].count + shown[i + 1].count;
    merged.push_back(std::move(shown[harder(shown[i + 1].frame, shown[i].frame) ? i + 1 : i]));
    merged.back().count = count;
  }
  if (shown.size() % 2 == 1) merged.push_back(std::move(shown.back()));  // which the next ones join
  shown = std::move(merged);
  per_shown *= 2;
}

}  // namespace

void SkinRecordingAnswer::add(std::optional<double> time, std::span<const double> frame_readings,
                              const FrameAnswer& found, bool estimated) {
  frames.push_back(
      {.time = time.value_or(unknown_value),
       .estimated = estimated,
       .verdict = found.verdict,
       .alpha = found.alpha,
       .wrench = found.wrench,
       .friction = found.friction ? std::optional(found.friction->ratio) : std::nullopt,
       .data = found.data.value_or(DataVerdict{}),
       .contacts = tracker.follow(frames.size(), found.patches)});
  show(*this, frame_readings, found);
  if (answer && found.wrench.normal.value <= answer->wrench.normal.value) return;
  hardest = frames.size() - 1;
  readings.assign(frame_readings.begin(), frame_readings.end());
  answer = found;
}

void SkinRecordingAnswer::skip(std::optional<double> time) {
  frames.push_back(
      {.time = time.value_or(unknown_value), .missing = true, .verdict = Verdict::failed});
  frames.back().wrench.normal = {unknown_value, unknown_value};
}

void SkinRecordingAnswer::times_without_unit() {
  for (Frame& frame : frames) frame.time = unknown_value;
}

FrameRuns SkinRecordingAnswer::skipped() const {
  FrameRuns runs;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].missing) runs.add(i);
  return runs;
}

FrameRuns SkinRecordingAnswer::estimated() const {
  FrameRuns runs;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].estimated) runs.add(i);
  return runs;
}

}  // namespace tactile_net::lab

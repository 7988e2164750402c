#include "tactile_net/lab/skin_recording.hpp"

#include <utility>

namespace tactile_net::lab {

void SkinRecordingAnswer::add(std::string time, std::span<const double> frame_readings,
                              const SkinAnswer& found) {
  frames.push_back(
      {.time = std::move(time),
       .verdict = found.verdict,
       .alpha = found.alpha,
       .wrench = found.wrench,
       .friction = found.friction ? std::optional(found.friction->ratio) : std::nullopt});
  if (answer && found.wrench.normal.value <= answer->wrench.normal.value) return;
  hardest = frames.size() - 1;
  readings.assign(frame_readings.begin(), frame_readings.end());
  answer = found;
}

}  // namespace tactile_net::lab

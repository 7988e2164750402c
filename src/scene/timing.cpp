#include "tactile_net/scene/timing.hpp"

#include <stdexcept>
#include <string>

namespace tactile_net {

void check_frame(const std::optional<Timing>& time, std::size_t frame) {
  if (!time && frame > 0)
    throw std::invalid_argument("there is no frame " + std::to_string(frame) +
                                ": the scene has no [time], and so frame 0 alone");
  const std::size_t frames = time ? time->frames : 1;
  if (frame >= frames)
    throw std::invalid_argument("frame must be from 0 to " + std::to_string(frames - 1) + " (got " +
                                std::to_string(frame) + ")");
}

}  // namespace tactile_net

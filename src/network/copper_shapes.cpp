#include "network/copper_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactile_net {

bool is_in(const LaidBoard::Pad& pad, double x, double y) {
  const double turn = pad.angle * std::numbers::pi / 180.0;
  const double dx = x - pad.x;
  const double dy = y - pad.y;
  return std::abs(dx * std::cos(turn) - dy * std::sin(turn)) <= 0.5 * pad.width + 1e-3 &&
         std::abs(dx * std::sin(turn) + dy * std::cos(turn)) <= 0.5 * pad.height + 1e-3;
}

double length_of(const LaidBoard::Track& track) {
  return std::hypot(track.to_x - track.from_x, track.to_y - track.from_y);
}

double along(const LaidBoard::Track& track, double x, double y) {
  const double length = length_of(track);
  if (!(length > 0.0)) return 0.0;
  const double dx = (track.to_x - track.from_x) / length;
  const double dy = (track.to_y - track.from_y) / length;
  return std::clamp((x - track.from_x) * dx + (y - track.from_y) * dy, 0.0, length);
}

bool is_on(const LaidBoard::Track& track, double x, double y) {
  const double length = length_of(track);
  const double share = length > 0.0 ? along(track, x, y) / length : 0.0;
  return std::hypot(x - track.from_x - share * (track.to_x - track.from_x),
                    y - track.from_y - share * (track.to_y - track.from_y)) <=
         0.5 * track.width + 1e-3;
}

}  // namespace tactile_net

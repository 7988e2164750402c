/// @file
/// Which point of a board lies on which copper. Private.
#pragma once

#include "tactile_net/network/laid_board.hpp"

namespace tactile_net {

/// Within a micrometre.
[[nodiscard]] bool is_in(const LaidBoard::Pad& pad, double x, double y);
[[nodiscard]] bool is_on(const LaidBoard::Track& track, double x, double y);

/// Of a point beside a track the nearest one of its middle, from its first end [mm].
[[nodiscard]] double along(const LaidBoard::Track& track, double x, double y);

[[nodiscard]] double length_of(const LaidBoard::Track& track);

}  // namespace tactile_net

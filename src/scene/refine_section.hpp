/// @file
/// How a circuit's answer is refined, network.refine. Private.
#pragma once

#include "scene/table.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net {

/// @param network  what has been read of the same section, its tolerance too
[[nodiscard]] RefinementOptions read_refine(const Value& refine, const NetworkOptions& network);

}  // namespace tactile_net

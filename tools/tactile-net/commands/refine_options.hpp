/// @file
/// What the command line says of a refinement, over the scene.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/network/refinement_options.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::tool {

/// "bits=12", "step=conjugate": as the keys of a scene's `refine`.
///
/// @param over  the scene's own options, or the usual ones
/// @throw WrongUsage  there is no such key, or its value is out of range
[[nodiscard]] RefinementOptions refine_options(const std::vector<std::string>& keys,
                                               RefinementOptions over);

/// The scene with them; without any it is as it says.
void refine_as(const std::vector<std::string>& keys, AnyScene& scene);

}  // namespace tactile_net::tool

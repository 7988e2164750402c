/// @file
/// The command `solve` for a skin: recorded readings to tractions.
#pragma once

#include "commands/solve.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::tool {

/// @throw WrongUsage  an option that skins do not know
void solve_skin(const SkinScene& scene, const SolveOptions& options, const Streams& streams);

}  // namespace tactile_net::tool

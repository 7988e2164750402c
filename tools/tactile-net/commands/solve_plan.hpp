/// @file
/// The command `solve` where a plan answers the frames, as a controller does.
#pragma once

#include "commands/solve.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {

/// @throw InputError  as `run`; or the plan is not the scene's
void solve_by_plan(const AnyScene& scene, const SolveOptions& options, const Streams& streams);

}  // namespace tactile_net::tool

/// @file
/// A scene's plan, for people and for machines.
#pragma once

#include <iosfwd>
#include <string>

#include "tactile_net/scene/plan.hpp"

namespace tactile_net::tool {

void print_plan(std::ostream& out, const Scene& scene, const ScenePlan& plan);

[[nodiscard]] std::string plan_json(const Scene& scene, const ScenePlan& plan);

}  // namespace tactile_net::tool

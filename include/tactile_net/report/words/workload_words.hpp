/// @file
/// A scene's plan, for people and for machines.
#pragma once

#include <iosfwd>
#include <string>

#include "tactile_net/lab/workload.hpp"

namespace tactile_net::report {

void print_plan(std::ostream& out, const Scene& scene, const lab::ScenePlan& plan);

[[nodiscard]] std::string plan_json(const Scene& scene, const lab::ScenePlan& plan);

}  // namespace tactile_net::report

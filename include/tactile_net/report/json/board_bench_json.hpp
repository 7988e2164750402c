/// @file
/// A board on the bench as JSON; the format is docs/documents.md.
#pragma once

#include <string>

#include "tactile_net/lab/board_bench.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string bench_json(const AnyScene& scene, const lab::BoardBench& bench);

}  // namespace tactile_net::report

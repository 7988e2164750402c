/// @file
/// Results as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "experiment.hpp"

namespace tactile_net::tool {

[[nodiscard]] std::string experiment_json(const Experiment& experiment);

/// The same document with the network alone.
[[nodiscard]] std::string relaxation_json(const Scene& scene, const Relaxation& relaxation);

}  // namespace tactile_net::tool

/// @file
/// What was found on a skin, as JSON.
#pragma once

#include <string>

#include "tactile_net/lab/skin_run.hpp"

namespace tactile_net::report {

/// docs/schemas/skin_run.json
[[nodiscard]] std::string experiment_json(const lab::SkinExperiment& experiment);

}  // namespace tactile_net::report

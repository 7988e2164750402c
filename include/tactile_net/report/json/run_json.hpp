/// @file
/// Results as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/run.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string experiment_json(const lab::Experiment& experiment);

}  // namespace tactile_net::report

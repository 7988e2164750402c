/// @file
/// Private. What is suspicious about a recording, as JSON.
#pragma once

#include "report/json/values.hpp"
#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::report {

/// Of each its kind, the sentence, the advice, and its numbers.
[[nodiscard]] Json findings_json(const lab::Findings& findings, const AnyScene& scene);

}  // namespace tactile_net::report

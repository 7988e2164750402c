/// @file
/// The check of a recording as JSON; keys in docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net::report {

/// @param readings  the recording's name
[[nodiscard]] std::string check_json(const lab::ReadingsCheck& check, const std::string& readings);

}  // namespace tactile_net::report

/// @file
/// A survey as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "tactile_net/lab/identify.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string survey_json(const Scene& scene, const lab::Survey& survey);

}  // namespace tactile_net::report

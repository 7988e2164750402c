/// @file
/// A survey as JSON; the format is docs/results.md.
#pragma once

#include <string>

#include "survey.hpp"

namespace tactile_net::tool {

[[nodiscard]] std::string survey_json(const Scene& scene, const Survey& survey);

}  // namespace tactile_net::tool

/// @file
/// A survey of a line or a skin as JSON: kind `identify`.
#pragma once

#include <string>

#include "tactile_net/lab/identify.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string survey_json(const Scene& scene, const lab::Survey& survey);
[[nodiscard]] std::string survey_json(const SkinScene& scene, const lab::Survey& survey);

}  // namespace tactile_net::report

/// @file
/// A survey of a skin's sensors as JSON (kind `skin_identify`).
#pragma once

#include <string>

#include "tactile_net/lab/skin_survey.hpp"

namespace tactile_net::report {

[[nodiscard]] std::string survey_json(const SkinScene& scene, const lab::SkinSurvey& survey);

}  // namespace tactile_net::report

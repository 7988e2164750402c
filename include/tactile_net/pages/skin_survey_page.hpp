/// @file
/// A survey of a skin's sensors for people: report.html.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/skin_survey.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page survey_html(const SkinScene& scene, const lab::SkinSurvey& survey,
                                        const Made& made = {});

}  // namespace tactile_net::pages

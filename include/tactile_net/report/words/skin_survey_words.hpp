/// @file
/// A survey of a skin's sensors in plain words: what determines p and the drags, what nothing
/// shows, what only the skin's ends decide, and what to read instead.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tactile_net/lab/skin_survey.hpp"
#include "tactile_net/report/words/answers.hpp"

namespace tactile_net::report {

/// "stress_x, shear_xy at 2 mm and 3 mm"
[[nodiscard]] std::string in_words(const lab::SkinSensorChoice& choice,
                                   const std::optional<Units>& units = {});

/// "p", "drag along the wave", "drag across it (the curl)"
[[nodiscard]] std::string in_words(SkinRipple ripple);

/// "The curl of q is seen by no depth of stress_x: ..."; one sentence for each kind of wave.
[[nodiscard]] std::vector<std::string> hidden_in_words(const lab::SkinSensorChoice& choice);

/// Sentences, the verdict itself first.
[[nodiscard]] std::vector<std::string> verdict_in_words(const SkinScene& scene,
                                                        const lab::SkinSurvey& survey);

/// Header and rows: what each quantity at each depth reads of one wave, over its noise.
[[nodiscard]] std::vector<std::vector<std::string>> share_cells(const SkinScene& scene,
                                                                const lab::SkinSurvey& survey);
/// How to read those cells.
[[nodiscard]] std::string shares_in_words(const SkinScene& scene, const lab::SkinSurvey& survey);

/// Header and rows of the comparison, the scene's own sensors first.
[[nodiscard]] std::vector<std::vector<std::string>> survey_cells(const SkinScene& scene,
                                                                 const lab::SkinSurvey& survey);
/// How to read those cells.
[[nodiscard]] std::string cells_in_words(const SkinScene& scene, const lab::SkinSurvey& survey);

/// From which wavelength on p and the drags are told, what is hidden, and what would tell more.
[[nodiscard]] std::vector<Answer> answers(const SkinScene& scene, const lab::SkinSurvey& survey);

/// All of it as text.
void print_survey(std::ostream& out, const SkinScene& scene, const lab::SkinSurvey& survey);

}  // namespace tactile_net::report

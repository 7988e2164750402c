/// @file
/// A survey of the sensors of a line or a skin in plain words: what cannot be told, why, what to
/// read instead, and how all compare. Its answers are in answers.hpp.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/identify.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// "stress_x, shear_xy at 2 mm and 3 mm"
[[nodiscard]] std::string in_words(const lab::SensorChoice& choice,
                                   const std::optional<Units>& units = {});

/// "1 % of the largest reading that a ripple of that normal traction causes"
[[nodiscard]] std::string in_words(const lab::AssumedNoise& noise);

/// "Dead taxels read nothing: what only they would show is lost."
[[nodiscard]] std::string in_words(const lab::HiddenReason& reason,
                                   const std::optional<Units>& units = {});

/// "p", "drag along the wave", "drag across it (the curl)"
[[nodiscard]] std::string in_words(SkinRipple ripple);

/// "The curl of q is seen by no depth of stress_x: ..."; none where everything shows.
[[nodiscard]] std::vector<std::string> hidden_in_words(const lab::Survey& survey,
                                                       const std::optional<Units>& units = {});

/// Sentences: `hidden_in_words` first, or that nothing is.
[[nodiscard]] std::vector<std::string> verdict_in_words(const lab::Survey& survey,
                                                        const std::optional<Units>& units = {});

/// Header and rows: what each quantity at each depth reads of one wave, over its noise.
[[nodiscard]] std::vector<std::vector<std::string>> share_cells(
    const lab::Survey& survey, const std::optional<Units>& units = {});
/// How to read those cells.
[[nodiscard]] std::string shares_in_words(const lab::Survey& survey,
                                          const std::optional<Units>& units = {});

/// Header and rows of the comparison, the scene's own sensors first.
[[nodiscard]] std::vector<std::vector<std::string>> survey_cells(
    const lab::Survey& survey, const std::optional<Units>& units = {});
/// How to read those cells.
[[nodiscard]] std::string cells_in_words(const lab::Survey& survey,
                                         const std::optional<Units>& units = {});

/// What the singular values of a line's sensors say, one sentence each.
[[nodiscard]] std::vector<std::string> singular_values_in_words(
    const Identifiability& result, const std::optional<Units>& units = {});

/// All of it as text.
void print_survey(std::ostream& out, const Scene& scene, const lab::Survey& survey);
void print_survey(std::ostream& out, const SkinScene& scene, const lab::Survey& survey);

}  // namespace tactile_net::report

/// @file
/// A survey for people: cells for the terminal, report.html.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/identify.hpp"

namespace tactile_net::pages {

/// Header and rows of the comparison, the scene's own sensors first.
[[nodiscard]] std::vector<std::vector<std::string>> survey_cells(
    const lab::Survey& survey, const std::optional<Units>& units = {});

/// How to read those cells.
[[nodiscard]] std::string cells_in_words(const Scene& scene, const lab::Survey& survey);

/// What the singular values of the scene's sensors say, one sentence each.
[[nodiscard]] std::vector<std::string> singular_values_in_words(
    const Identifiability& result, const std::optional<Units>& units = {});

[[nodiscard]] drawing::Page survey_html(const Scene& scene, const lab::Survey& survey);

}  // namespace tactile_net::pages

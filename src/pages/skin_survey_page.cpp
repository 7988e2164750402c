#include "tactile_net/pages/skin_survey_page.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "pages/skin_map.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/skin_survey_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::figure_html;
using drawing::html_table;
using drawing::Page;

constexpr double full_colour = 10.0;  // times the noise

/// Wavenumbers along one axis, each once, from 0.
std::vector<double> wavenumbers(const std::vector<SkinResolution>& all,
                                double SkinResolution::*along) {
  std::set<double> values;
  for (const SkinResolution& one : all) values.insert(std::abs(one.*along));
  return {values.begin(), values.end()};
}

std::size_t index_of(const std::vector<double>& values, double wavenumber) {
  const auto at = std::lower_bound(values.begin(), values.end(), std::abs(wavenumber));
  return static_cast<std::size_t>(at - values.begin());
}

/// How long a wave is.
std::string end_of(const SkinScene& scene, double wavenumber) {
  return wavenumber > 0.0
             ? report::in_unit(scene.units, Dimension::length, 6.283185307179586 / wavenumber)
             : "∞";
}

/// How far the ripples of one part stand out of the noise: a square for each wave, those that run
/// to either side of y being alike.
std::string wave_map(const SkinScene& scene, const lab::SkinSurvey& survey, SkinRipple ripple) {
  const auto& all = survey.own.resolutions;
  const std::vector<double> y = wavenumbers(all, &SkinResolution::wavenumber_y);
  const std::vector<double> z = wavenumbers(all, &SkinResolution::wavenumber_z);
  const MapGrid grid{.rows = y.size(), .columns = z.size()};
  std::vector<double> times(grid.rows * grid.columns);
  std::vector<bool> told(times.size());
  for (const SkinResolution& one : all) {
    const std::size_t cell =
        index_of(y, one.wavenumber_y) * grid.columns + index_of(z, one.wavenumber_z);
    const double ratio = survey.traction / one.of_wave[static_cast<std::size_t>(ripple)];
    times[cell] = std::min(ratio, full_colour);
    told[cell] = ratio >= 1.0;
  }
  const std::string title = report::in_words(ripple);
  return map_picture(
      grid,
      {.left = end_of(scene, y.front()),
       .across = "wave along y →",
       .right = end_of(scene, y.back()),
       .top = end_of(scene, z.front()),
       .down = "z ↓",
       .bottom = end_of(scene, z.back())},
      title, "Which ripples stand out of the noise: " + title,
      map_image(grid, times, full_colour, MapColours::sizes) + map_outline(grid, told));
}

std::string waves_figure(const SkinScene& scene, const lab::SkinSurvey& survey) {
  std::vector<std::string> pictures;
  for (const SkinRipple ripple : lab::ripples_of(survey.own.components))
    pictures.push_back(wave_map(scene, survey, ripple));
  return figure_html(
      "waves",
      maps(pictures) +
          colour_bar(MapColours::sizes, {"times the noise, or more", 1.0}, full_colour, false, ""),
      "What the scene's sensors see away from the ends of the skin: a square for each wave, "
      "uniform at the upper left, shorter to the right along y and downwards along z. The darker, "
      "the further a ripple of " +
          report::in_unit(scene.units, Dimension::stress, survey.traction) +
          " stands out of the noise; the line runs around those that do.",
      "waves.csv", "skin");
}

/// The numbers behind the maps.
std::string waves_csv(const lab::SkinSurvey& survey) {
  std::string csv = "wavenumber_y,wavenumber_z,pressure,drag_along,drag_across\n";
  for (const SkinResolution& one : survey.own.resolutions) {
    csv += shortest(one.wavenumber_y) + ',' + shortest(one.wavenumber_z);
    for (const double deviation : one.of_wave)
      csv += ',' + (std::isfinite(deviation) ? shortest(deviation) : std::string{});
    csv += '\n';
  }
  return csv;
}

}  // namespace

Page survey_html(const SkinScene& scene, const lab::SkinSurvey& survey, const Made& made) {
  Page page{.files = {{"waves.csv", waves_csv(survey)}}};
  std::string html =
      heading(scene.title, scene.file,
              report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(scene, survey));
  const std::vector<std::string> hidden = report::hidden_in_words(survey.own);
  const std::vector<std::string> verdict = report::verdict_in_words(scene, survey);
  html += paragraphs(hidden, "bad");
  html +=
      paragraphs({verdict.begin() + static_cast<std::ptrdiff_t>(hidden.size()), verdict.end()}, "");
  html += waves_figure(scene, survey);
  html += element("h2", "Which reading determines what");
  html += element("p", report::shares_in_words(scene, survey));
  html += html_table(report::share_cells(scene, survey));
  html += element("h2", "Which quantities, at which depth");
  html += element("p", report::cells_in_words(scene, survey));
  html += html_table(report::survey_cells(scene, survey));
  html += colophon("The scene, the files, the command", scene_html(scene), page.files, made);
  page.html = page_html(scene.file + " - tactile-net identify", html);
  return page;
}

}  // namespace tactile_net::pages

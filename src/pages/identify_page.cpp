#include "tactile_net/pages/identify_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "pages/axis.hpp"
#include "pages/pad_drawing.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/json/waves_json.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::figure_html;
using drawing::Figures;
using drawing::html_list;
using drawing::html_table;
using drawing::Page;
using drawing::Plot;
using report::answers;
using report::in_words;
using report::material_in_words;
using report::sensor_in_words;
using report::verdict_in_words;

double deviation(const SkinResolution& resolution, SkinRipple part) {
  return resolution.of_wave[static_cast<std::size_t>(part)];
}

Plot singular_value_plot(const Identifiability& result) {
  Plot plot{"Singular values", "number", "singular value [1 / unit of E]", {}, {}, false, true};
  Curve values{"singular values", {}, 1, true};
  for (const double value : result.singular_values) {
    plot.x.push_back(static_cast<double>(plot.x.size() + 1));
    values.y.push_back(value);
  }
  plot.curves.push_back(std::move(values));
  plot.curves.push_back({"rounding", std::vector<double>(plot.x.size(), result.floor), 0});
  return plot;
}

/// The scene's sensors and the alternatives that tell most, at most so many in all.
std::vector<const lab::SensorChoice*> drawn(const lab::Survey& survey, std::size_t most) {
  std::vector<const lab::SensorChoice*> choices;
  for (const lab::SensorChoice& choice : survey.alternatives)
    if (choice.unknowns == survey.own.unknowns) choices.push_back(&choice);
  std::stable_sort(choices.begin(), choices.end(),
                   [](auto a, auto b) { return lab::tells_more(*a, *b); });
  choices.resize(std::min(choices.size(), most - 1));
  choices.insert(choices.begin(), &survey.own);
  return choices;
}

Plot deviation_plot(const Scene& scene, const lab::Survey& survey, SkinRipple component) {
  // Far above the traction nothing is left to see: a curve ends there.
  constexpr double top = 1e4;
  const std::vector<const lab::SensorChoice*> choices = drawn(survey, 5);
  double shortest = std::numeric_limits<double>::infinity();
  for (const lab::SensorChoice* choice : choices)
    for (const SkinResolution& resolution : choice->resolutions)
      if (deviation(resolution, component) <= top * survey.traction)
        shortest = std::min(shortest, resolution.wavelength());
  const auto shown = [&](const SkinResolution& resolution) {
    return std::isfinite(resolution.wavelength()) && resolution.wavelength() >= shortest;
  };
  std::vector<double> wavelengths;
  for (const SkinResolution& resolution : survey.own.resolutions)
    if (shown(resolution)) wavelengths.push_back(resolution.wavelength());
  const PlotAxis along =
      axis(scene.units, "wavelength of a ripple", Dimension::length, {&wavelengths});
  Plot plot{std::string(component == SkinRipple::pressure ? "Normal" : "Tangential") +
                " traction: what noise hides",
            along.label,
            "standard deviation / ripple",
            along(wavelengths),
            {},
            true,
            true};
  for (const lab::SensorChoice* choice : choices) {
    Curve line{in_words(*choice, scene.units) + (choice == &survey.own ? " (now)" : ""),
               {},
               plot.curves.size() + 1};
    for (const SkinResolution& resolution : choice->resolutions)
      if (shown(resolution)) {
        const double ratio = deviation(resolution, component) / survey.traction;
        line.y.push_back(ratio <= top ? ratio : std::numeric_limits<double>::quiet_NaN());
      }
    plot.curves.push_back(std::move(line));
  }
  plot.curves.push_back({"the ripple itself", std::vector<double>(plot.x.size(), 1.0), 0});
  plot.curves.back().width = 4.0;
  return plot;
}

/// The wavelengths of a survey on a logarithmic line, 0 to 1000 from the shortest to the longest.
struct Spectrum {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;

  explicit Spectrum(const lab::SensorChoice& choice) {
    for (const SkinResolution& resolution : choice.resolutions) {
      if (!std::isfinite(resolution.wavelength())) continue;
      shortest = std::min(shortest, resolution.wavelength());
      longest = std::max(longest, resolution.wavelength());
    }
  }
  [[nodiscard]] double at(double wavelength) const {
    return 1000.0 *
           std::clamp(std::log(wavelength / shortest) / std::log(longest / shortest), 0.0, 1.0);
  }
};

/// What of one traction stands out of the noise: full colour where ten times as much, none where
/// the noise is larger.
std::string sight(const lab::SensorChoice& choice, SkinRipple component, double traction,
                  const Spectrum& spectrum, double top, double height) {
  const std::string place = "\" y=\"" + fixed(top, 0) + "\" height=\"" + fixed(height, 0) + "\"";
  std::string svg = "<rect class=\"room\" x=\"0\" width=\"1000" + place + "/>";
  const auto& all = choice.resolutions;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double ratio = deviation(all[j], component) / traction;
    if (!std::isfinite(all[j].wavelength()) || !(ratio <= 1.0)) continue;
    // From half way to the next longer wavelength to half way to the next shorter one.
    const double here = all[j].wavelength();
    const double longer =
        j > 0 && std::isfinite(all[j - 1].wavelength()) ? all[j - 1].wavelength() : here;
    const double shorter = j + 1 < all.size() ? all[j + 1].wavelength() : here;
    const double from = spectrum.at(std::sqrt(here * shorter));
    const double to = spectrum.at(std::sqrt(here * longer));
    const double opacity = std::min(1.0, 0.3 - 0.7 * std::log10(std::max(ratio, 1e-3)));
    svg += "<rect class=\"" +
           std::string(component == SkinRipple::pressure ? "normal" : "tangential") + "\" x=\"" +
           fixed(from, 1) + "\" width=\"" + fixed(to - from + 0.5, 1) + place + " fill-opacity=\"" +
           fixed(opacity, 2) + "\"/>";
  }
  return svg;
}

/// The numbers behind the bars.
Plot sight_plot(const Scene& scene, const std::vector<const lab::SensorChoice*>& choices,
                double traction) {
  std::vector<double> wavelengths;
  for (const SkinResolution& resolution : choices.front()->resolutions)
    if (std::isfinite(resolution.wavelength())) wavelengths.push_back(resolution.wavelength());
  const PlotAxis along =
      axis(scene.units, "wavelength of a ripple", Dimension::length, {&wavelengths});
  Plot plot{"", along.label, "standard deviation / ripple", along(wavelengths), {}};
  for (const lab::SensorChoice* choice : choices)
    for (const SkinRipple component : lab::ripples_of(choice->unknowns)) {
      Curve curve{in_words(*choice, scene.units) +
                      (component == SkinRipple::pressure ? ", normal" : ", tangential"),
                  {}};
      for (const SkinResolution& resolution : choice->resolutions)
        if (std::isfinite(resolution.wavelength()))
          curve.y.push_back(deviation(resolution, component) / traction);
      plot.curves.push_back(std::move(curve));
    }
  return plot;
}

/// What every choice of sensors sees, by wavelength: a bar each, for two tractions one on the
/// other.
Figure sight_figure(const Scene& scene, const lab::Survey& survey) {
  const Spectrum spectrum(survey.own);
  const bool two = survey.own.unknowns == 2;
  const auto length = [&](double value) {
    return report::in_unit(scene, Dimension::length, value);
  };
  const std::vector<const lab::SensorChoice*> choices = drawn(survey, 8);
  std::string html = "<div class=\"bars\">\n";
  for (const lab::SensorChoice* choice : choices) {
    const bool own = choice == &survey.own;
    html +=
        element("span", in_words(*choice, scene.units) + (own ? " (now)" : ""), own ? "own" : "");
    const auto normal = choice->resolvable(SkinRipple::pressure);
    const std::string told = normal ? "normal from " + length(*normal) : "no normal";
    html +=
        "<svg viewBox=\"0 0 1000 100\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" +
        drawing::escaped(in_words(*choice, scene.units) + ": " + told) + "\">" +
        sight(*choice, SkinRipple::pressure, survey.traction, spectrum, 0.0, two ? 46.0 : 100.0) +
        (two ? sight(*choice, SkinRipple::drag_along, survey.traction, spectrum, 54.0, 46.0) : "") +
        "</svg>\n";
  }
  html += "<div class=\"scale\">" + element("span", "wavelength " + length(spectrum.shortest)) +
          element("span", length(std::sqrt(spectrum.shortest * spectrum.longest))) +
          element("span", length(spectrum.longest)) + "</div></div>\n";
  return {.name = "sight",
          .section = "answer",
          .caption =
              "What each choice of sensors sees, by the wavelength of a ripple: coloured "
              "where it stands out of the noise, in full where ten times as far" +
              std::string(two ? "; blue is normal, orange tangential" : "") + ".",
          .plot = sight_plot(scene, choices, survey.traction),
          .picture = std::move(html)};
}

std::vector<Figure> figures_of(const Scene& scene, const lab::Survey& survey) {
  const std::string ripples =
      "How far noise leaves the amplitude of a ripple uncertain in one frame, for the scene's "
      "sensors (now) and the best of the others in their place. A ripple stands out of the noise "
      "where a curve lies below the heavy line: the further left it crosses, the finer the detail "
      "that can be told.";
  std::vector<Figure> figures = {
      {.name = "pad",
       .section = "answer",
       .caption = "The pad in section, to scale: the deeper the taxels below the surface, the more "
                  "the pad smooths before they read.",
       .plot = {},
       .picture = draw_pad(scene, false),
       .data = "result.json"},
      sight_figure(scene, survey),
      {"singular-values", "scene",
       "How strongly the combinations of tractions show in the readings, in units of the noise, "
       "strongest first. The lower a dot, the more its combination is drowned; those on or below "
       "the heavy line are lost to rounding, whatever the noise; one of exactly 0 has no place "
       "here.",
       singular_value_plot(*survey.own.identifiability)},
      {"resolution-normal", "others", ripples,
       deviation_plot(scene, survey, SkinRipple::pressure)}};
  if (survey.own.unknowns == 2)
    figures.push_back({"resolution-tangential", "others", "The same for the tangential traction.",
                       deviation_plot(scene, survey, SkinRipple::drag_along)});
  std::erase_if(figures, [](const Figure& figure) {
    return figure.plot.x.empty() && figure.picture.empty();
  });
  return figures;
}

// A skin's map: a square for each wave.

std::string waves_figure(const SkinScene& scene, const lab::Survey& survey) {
  return figure_html(
      "waves",
      "<div class=\"waves maps\">" + drawing::data_html(report::waves_json(scene, survey)) +
          "</div>\n",
      "What the scene's sensors see away from the ends of the skin: a square for each wave, "
      "uniform at the upper left, shorter to the right along y and downwards along z. The darker, "
      "the further a ripple of " +
          report::in_unit(scene.units, Dimension::stress, survey.traction) +
          " stands out of the noise; the line runs around those that do, and the pointer tells how "
          "far.",
      "waves.csv", "skin");
}

/// The numbers behind the maps.
std::string waves_csv(const lab::Survey& survey) {
  std::string csv = "wavenumber_y,wavenumber_z,pressure,drag_along,drag_across\n";
  for (const SkinResolution& one : survey.own.resolutions) {
    csv += shortest(one.wavenumber_y) + ',' + shortest(one.wavenumber_z);
    for (const double deviation : one.of_wave)
      csv += ',' + (std::isfinite(deviation) ? shortest(deviation) : std::string{});
    csv += '\n';
  }
  return csv;
}

// What is the same of both.

/// What is drawn of the answer and of the others, and how a line's singular values lie.
struct SurveyFigures {
  std::string answer, others, singular_values;
  drawing::Files files;
};

SurveyFigures figures_with(const Scene& scene, const lab::Survey& survey) {
  const Figures figures(figures_of(scene, survey));
  return {figures.html("answer"), figures.html("others"), figures.html("scene"), figures.data()};
}
SurveyFigures figures_with(const SkinScene& scene, const lab::Survey& survey) {
  return {waves_figure(scene, survey), "", "", {{"waves.csv", waves_csv(survey)}}};
}

Page survey_page(const auto& scene, const lab::Survey& survey, const Made& made) {
  const std::optional<Units>& units = scene.units;
  const SurveyFigures figures = figures_with(scene, survey);
  Page page{.files = figures.files};
  std::string html =
      heading(scene.title, scene.file, sensor_in_words(scene) + "; " + material_in_words(scene));
  html += answer_box(answers(survey, units));
  const std::vector<std::string> hidden = report::hidden_in_words(survey, units);
  const std::vector<std::string> verdict = verdict_in_words(survey, units);
  html += paragraphs(hidden, "bad");
  html +=
      paragraphs({verdict.begin() + static_cast<std::ptrdiff_t>(hidden.size()), verdict.end()}, "");
  html += figures.answer;
  html += element("h2", "Which reading determines what");
  html += element("p", report::shares_in_words(survey, units));
  html += html_table(report::share_cells(survey, units));
  html += element("h2", "Which quantities, at which depth");
  html += element("p", report::cells_in_words(survey, units));
  html += html_table(report::survey_cells(survey, units));
  html += figures.others;
  if (survey.own.identifiability) {
    html += element("h2", "What these sensors hide, by singular values");
    html += html_list(report::singular_values_in_words(*survey.own.identifiability, units));
    html += figures.singular_values;
  }
  html += colophon("The scene, the files, the command", scene_html(scene), page.files, made);
  page.html = page_html(scene.file + " - tactile-net identify", html);
  return page;
}

}  // namespace

Page survey_html(const Scene& scene, const lab::Survey& survey, const Made& made) {
  return survey_page(scene, survey, made);
}
Page survey_html(const SkinScene& scene, const lab::Survey& survey, const Made& made) {
  return survey_page(scene, survey, made);
}

}  // namespace tactile_net::pages

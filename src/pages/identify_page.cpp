#include "tactile_net/pages/identify_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/mode_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::element;
using drawing::Figure;
using drawing::Figures;
using drawing::html_list;
using drawing::html_page;
using drawing::html_table;
using drawing::Page;
using drawing::Plot;
using report::in_short;
using report::in_words;
using report::material_in_words;
using report::sensor_in_words;
using report::verdict_in_words;
using report::wavelengths_in_short;

double deviation(const Resolution& resolution, Traction component) {
  return component == Traction::normal ? resolution.normal : resolution.tangential;
}

std::string condition_in_words(const Identifiability& result) {
  return result.null_space.dimension > 0 ? "singular" : brief(result.condition);
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

/// The scene's sensors and the alternatives that tell most, at most five in all.
std::vector<const lab::SensorChoice*> drawn(const lab::Survey& survey) {
  std::vector<const lab::SensorChoice*> choices;
  for (const lab::SensorChoice& choice : survey.alternatives)
    if (choice.unknowns == survey.own.unknowns) choices.push_back(&choice);
  std::stable_sort(choices.begin(), choices.end(),
                   [](auto a, auto b) { return lab::tells_more(*a, *b); });
  choices.resize(std::min<std::size_t>(choices.size(), 4));
  choices.insert(choices.begin(), &survey.own);
  return choices;
}

Plot deviation_plot(const lab::Survey& survey, Traction component) {
  Plot plot{std::string(component == Traction::normal ? "Normal" : "Tangential") +
                " traction: what noise hides",
            "wavelength of a ripple [unit of the pitch]",
            "standard deviation / ripple",
            {},
            {},
            true,
            true};
  // Far above the traction nothing is left to see: a curve ends there.
  constexpr double top = 1e4;
  double shortest = std::numeric_limits<double>::infinity();
  for (const lab::SensorChoice* choice : drawn(survey))
    for (const Resolution& resolution : choice->resolutions)
      if (deviation(resolution, component) <= top * survey.traction)
        shortest = std::min(shortest, resolution.wavelength);
  const auto shown = [&](const Resolution& resolution) {
    return std::isfinite(resolution.wavelength) && resolution.wavelength >= shortest;
  };
  for (const Resolution& resolution : survey.own.resolutions)
    if (shown(resolution)) plot.x.push_back(resolution.wavelength);
  for (const lab::SensorChoice* choice : drawn(survey)) {
    Curve line{
        in_words(*choice) + (choice == &survey.own ? " (now)" : ""), {}, plot.curves.size() + 1};
    for (const Resolution& resolution : choice->resolutions)
      if (shown(resolution)) {
        const double ratio = deviation(resolution, component) / survey.traction;
        line.y.push_back(ratio <= top ? ratio : std::numeric_limits<double>::quiet_NaN());
      }
    plot.curves.push_back(std::move(line));
  }
  plot.curves.push_back({"the ripple itself", std::vector<double>(plot.x.size(), 1.0), 0});
  return plot;
}

std::vector<Figure> figures_of(const lab::Survey& survey) {
  const std::string ripples =
      "How far noise leaves the amplitude of a ripple uncertain in one frame, for the scene's "
      "sensors (now) and the best of the others in their place. A ripple stands out of the noise "
      "where a curve lies below the heavy line: the further left it crosses, the finer the detail "
      "that can be told.";
  std::vector<Figure> figures = {
      {"singular-values", "scene",
       "How strongly the combinations of tractions show in the readings, in units of the noise, "
       "strongest first. The lower a dot, the more its combination is drowned; those on or below "
       "the heavy line are lost to rounding, whatever the noise; one of exactly 0 has no place "
       "here.",
       singular_value_plot(survey.own.identifiability)},
      {"resolution-normal", "others", ripples, deviation_plot(survey, Traction::normal)}};
  if (survey.own.unknowns == 2)
    figures.push_back({"resolution-tangential", "others", "The same for the tangential traction.",
                       deviation_plot(survey, Traction::tangential)});
  std::erase_if(figures, [](const Figure& figure) { return figure.plot.x.empty(); });
  return figures;
}

}  // namespace

std::vector<std::vector<std::string>> survey_cells(const lab::Survey& survey,
                                                   const std::optional<Units>& units) {
  std::vector<std::vector<std::string>> rows = {{"reads", "unknowns", "condition", "hidden",
                                                 "hidden mean", "normal from", "tangential from"}};
  const auto wavelength = [&](const std::optional<double>& value) {
    return value ? report::in_unit(units, Dimension::length, *value) : std::string("none");
  };
  const auto add = [&](const lab::SensorChoice& choice, const std::string& mark) {
    const bool two = choice.unknowns == 2;
    std::vector<std::string> means;
    if (lab::hides_mean(choice, Traction::normal)) means.emplace_back("normal");
    if (two && lab::hides_mean(choice, Traction::tangential)) means.emplace_back("tangential");
    rows.push_back({in_words(choice, units) + mark, std::to_string(choice.unknowns),
                    condition_in_words(choice.identifiability),
                    in_short(choice.identifiability.null_space, units),
                    means.empty() ? "-" : join(means, ", "), wavelength(choice.normal),
                    two ? wavelength(choice.tangential) : "-"});
  };
  add(survey.own, " (the scene's)");
  for (const lab::SensorChoice& choice : survey.alternatives) add(choice, "");
  return rows;
}

std::string cells_in_words(const Scene& scene, const lab::Survey& survey) {
  std::string text =
      "normal from, tangential from: the shortest wavelength from which on every ripple of "
      "amplitude " +
      report::in_unit(scene, Dimension::stress, survey.traction) +
      " stands out of the noise, by its standard deviation in one frame; hidden mean: shows only "
      "at "
      "the array's ends. Noise: " +
      in_words(survey.noise) + ".";
  if (survey.taxels < scene.sensor.count)
    text += " Condition and hidden combinations of the alternatives are of " +
            std::to_string(survey.taxels) + " taxels.";
  return text;
}

std::vector<std::string> singular_values_in_words(const Identifiability& result,
                                                  const std::optional<Units>& units) {
  std::vector<std::string> text;
  text.push_back("singular values: " + std::to_string(result.singular_values.size()) + ", from " +
                 brief(result.singular_values.front()) + " to " +
                 brief(result.singular_values.back()) + " in units of the noise; rank " +
                 std::to_string(result.rank) + ", condition " + condition_in_words(result));
  text.push_back(result.null_space.dimension > 0
                     ? "noise gain: unbounded without smoothing"
                     : "noise gain: noise of the assumed size may become a traction of " +
                           report::in_unit(units, Dimension::stress, result.noise_gain) +
                           " without smoothing");
  for (const ModeSpace* space : {&result.null_space, &result.nearly_null}) {
    const bool null = space == &result.null_space;
    const std::size_t shown = std::min<std::size_t>(space->modes.size(), 3);
    const std::string kind = null ? "hidden: " : "nearly hidden: ";
    for (std::size_t i = 0; i < shown; ++i)
      text.push_back(
          kind + in_words(space->modes[i], units) +
          (null ? "" : " (singular value " + brief(space->modes[i].singular_value) + ")"));
    if (space->dimension > shown)
      text.push_back(kind + std::to_string(space->dimension - shown) + " more" +
                     wavelengths_in_short(*space, units));
  }
  return text;
}

Page survey_html(const Scene& scene, const lab::Survey& survey) {
  const Figures figures(figures_of(survey));
  Page result{.missing = figures.missing(), .files = figures.data()};

  std::string body = element("h1", scene.title.empty() ? scene.file : scene.title);
  body += element(
      "p", scene.file + ": " + sensor_in_words(scene) + "; " + material_in_words(scene) + ".");
  body += element("h2", "What these sensors can tell");
  const std::vector<std::string> verdict = verdict_in_words(survey, scene.units);
  const bool hidden = survey.own.identifiability.null_space.dimension > 0;
  body += element("p", verdict.front(), hidden ? "bad" : "");
  for (std::size_t i = 1; i < verdict.size(); ++i) body += element("p", verdict[i]);
  body += html_list(singular_values_in_words(survey.own.identifiability, scene.units));
  if (!result.missing.empty()) body += element("p", result.missing, "note");
  body += figures.html("scene");
  body += element("h2", "Which quantities, at which depth");
  body += element("p", cells_in_words(scene, survey));
  body += html_table(survey_cells(survey, scene.units));
  body += figures.html("others");
  body += "<p>All numbers: <a href=\"result.json\">result.json</a>.</p>\n";
  result.html = html_page(scene.file + " - tactile-net identify", body);
  return result;
}

}  // namespace tactile_net::pages

#include <utility>

#include "pages/alpha_figure.hpp"
#include "pages/frames_section.hpp"
#include "pages/network_section.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/pages/run_page.hpp"
#include "tactile_net/report/csv/run_csv.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::pages {

using drawing::element;

drawing::Page skin_run_page(const lab::Experiment& experiment, const std::string& by) {
  const SkinScene& scene = experiment.skin();
  const lab::MethodResult& result = experiment.results.front();
  drawing::Page page{.files = report::run_files(experiment)};
  std::string html =
      heading(scene.title, scene.file,
              report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(experiment));
  html += remarks_html({.warnings = report::in_words(experiment.frame)});
  html += remarks_html(report::remarks_in_words(experiment, result));
  if (!result.has_answer()) html += element("p", result.refusal, "bad");
  if (result.has_answer() || experiment.has_truth()) html += frames_section(experiment);
  if (result.has_answer()) html += frame_html(experiment);
  if (experiment.sweep) {
    const auto rule = *experiment.rule();
    const drawing::Figures figures({alpha_figure(*experiment.sweep, rule, "")});
    html += element("h2", "The choice of alpha") +
            element("p", "Every rule on these readings, constraints aside; " +
                             std::string(name(rule)) + " was used.") +
            verdict_table(report::rule_cells(*experiment.sweep)) + figures.html("");
    for (auto& file : figures.data()) page.files.push_back(std::move(file));
  }
  if (const lab::MethodResult* network = experiment.result(Method::network)) {
    html += experiment.relaxation
                ? network_section(*experiment.relaxation)
                : element("h2", "The circuit") + element("p", network->refusal, "bad");
    if (network->has_answer())
      html +=
          element("p", "The circuit is off the true " + report::errors_in_words(*network) + ".");
  }
  html += colophon("The scene, the files, the command", scene_html(scene), page.files,
                   Made{.by = by, .files = {"result.json"}});
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages

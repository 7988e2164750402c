#include "tactile_net/pages/skin_page.hpp"

#include "pages/frames_section.hpp"
#include "pages/network_section.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::pages {

using drawing::element;

drawing::Page run_page(const lab::SkinExperiment& experiment, const std::string& by) {
  const SkinScene& scene = experiment.scene;
  drawing::Page page{.files = report::run_files(experiment)};
  std::string html =
      heading(scene.title, scene.file,
              report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(experiment));
  html += remarks_html(report::remarks_in_words(experiment));
  if (!experiment.answer) html += element("p", experiment.refusal, "bad");
  if (experiment.answer || experiment.has_truth()) html += frames_section(experiment);
  if (experiment.answer) html += frame_html(experiment);
  if (const auto& network = experiment.network) {
    html += network->relaxation
                ? network_section(*network->relaxation)
                : element("h2", "The circuit") + element("p", network->refusal, "bad");
    if (network->relaxation) html += element("p", report::network_errors_in_words(*network));
  }
  html += colophon("The scene, the files, the command", scene_html(scene), page.files,
                   Made{.by = by, .files = {"result.json"}});
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages

#include "pages/skin_figures.hpp"

#include "pages/pad_drawing.hpp"
#include "pages/parts.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/contact_words.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::figure_html;

}  // namespace

std::string scene_html(const SkinScene& scene) {
  return element("p", "Sensor: " + report::sensor_in_words(scene) +
                          ". Material: " + report::material_in_words(scene) +
                          ". Forward model: " + std::string(name(scene.forward)) + ".") +
         drawing::html_list(report::contacts_in_words(scene));
}

namespace {

std::string pad_section_figure(const lab::Experiment& experiment) {
  return figure_html(
      "pad", pad_picture(experiment),
      std::string("The pad to scale, cut along y through the peak. On top what presses and "
                  "drags, ") +
          (experiment.has_truth() ? "true" : "as found") +
          "; inside, the stress across the surface that it causes, which is "
          "what smooths: blue presses, red pulls. The taxels of all rows are drawn in "
          "one plane.",
      "tractions.csv", "skin");
}

std::string judgement(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const lab::FrameAnswer& answer = experiment.results.front().answer;
  std::string html =
      element("h2", experiment.has_truth() ? "Found beside true" : "What was found") +
      drawing::html_table(report::found_cells(experiment));
  if (const auto rows = report::patch_cells(scene.units, answer.patches, {},
                                            report::true_contacts(experiment.scene));
      !rows.empty()) {
    const std::string table = drawing::html_table(rows);
    html += element("p", "Each contact by itself:") +
            (scene.sensor.curved ? drawing::enclosed("div", table, "many") : table);
  }
  html += "<p>" + verdict_mark(std::string(name(answer.verdict))) + " " +
          drawing::escaped(drawing::typeset(
              "alpha " + brief(answer.alpha.value) + " (" + std::string(source(answer.alpha)) +
              "), " + report::grid_in_words(scene, experiment.grid) +
              ". Data: " + report::data_word(*answer.data, scene) + ".")) +
          "</p>\n";
  if (answer.cone)
    html += element("p", "Under the constraints " + std::to_string(answer.cone->slip) +
                             " cells slide, " + std::to_string(answer.cone->stick) + " stick, " +
                             std::to_string(answer.cone->separation) + " touch nothing; found in " +
                             std::to_string(answer.cone->iterations) + " iterations.");
  return html;
}

}  // namespace

std::string frame_html(const lab::Experiment& experiment) {
  return pad_section_figure(experiment) + judgement(experiment);
}

}  // namespace tactile_net::pages

#include "tactile_net/pages/recording_page.hpp"

#include <optional>
#include <variant>

#include "pages/frames_section.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/csv/run_csv.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::pages {

using drawing::element;
using drawing::enclosed;
using drawing::escaped;
using drawing::words_html;

namespace {

/// What presses hardest on a skin.
/// @pre  there is one
lab::Experiment hardest_frame(const lab::RecordingOverview& overview) {
  lab::Experiment hardest{
      .scene = overview.skin(), .frame = {.readings = overview.readings}, .grid = overview.grid};
  hardest.results.push_back({.answer = *overview.answer});
  return hardest;
}

std::string scene_part(const lab::RecordingOverview& overview, const std::string& readings) {
  if (!overview.is_line()) return scene_html(overview.skin());
  const Scene& scene = overview.line();
  return enclosed("p", escaped(scene.file) + ": " +
                           words_html(report::sensor_in_words(scene) + "; " +
                                      report::material_in_words(scene) + ". Readings: ") +
                           escaped(readings) + ".");
}

}  // namespace

drawing::Page recording_page(const lab::RecordingOverview& overview, const std::string& readings,
                             const std::vector<std::string>& notes, const Made& made) {
  const std::string title =
      std::visit([](const auto& scene) { return scene.title; }, overview.scene);
  const std::optional<lab::Experiment> hardest =
      overview.answer ? std::optional(hardest_frame(overview)) : std::nullopt;
  drawing::Page page;
  if (hardest) page.files = report::run_files(*hardest);
  const bool shown = !overview.groups.empty();
  std::string html = heading(title, readings, report::recording_in_words(overview));
  html += overview.frames > 0 ? answer_box(report::answers(overview))
                              : enclosed("p", escaped(readings) + " holds no frame.", "bad");
  html += suspicions(overview.findings, overview.scene) + paragraphs(notes, "note");
  if (hardest) html += remarks_html(report::remarks_in_words(*overview.answer));
  if (shown)
    html += drawing::html_list(report::distrusted_in_words(overview)) + frames_section(overview);
  if (hardest && overview.frames > 1)
    html += element("h2", "Frame " + std::to_string(overview.hardest) + ", which presses hardest");
  if (hardest) html += frame_html(*hardest);
  html += colophon("The scene, the files, the command", scene_part(overview, readings), page.files,
                   made);
  page.html = page_html(readings + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages

#include "tactile_net/pages/recording_page.hpp"

#include "pages/frames_section.hpp"
#include "pages/parts.hpp"
#include "pages/skin_figures.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::pages {

using drawing::element;
using drawing::enclosed;
using drawing::escaped;
using drawing::words_html;

drawing::Page recording_page(const lab::RecordingOverview& overview, const std::string& readings,
                             const std::vector<std::string>& notes, const Made& made) {
  const Scene& scene = overview.scene;
  std::string html = enclosed("h1", escaped(scene.title.empty() ? readings : scene.title));
  html += element("p", report::recording_in_words(overview), "quiet");
  html += overview.groups.empty() ? enclosed("p", escaped(readings) + " holds no frame.", "bad")
                                  : answer_box(report::answers(overview));
  html += suspicions(overview.findings, scene) + paragraphs(notes, "note");
  if (!overview.groups.empty())
    html += drawing::html_list(report::distrusted_in_words(overview)) + frames_section(overview);
  html += colophon("The scene, the method, the files",
                   enclosed("p", escaped(scene.file) + ": " +
                                     words_html(report::sensor_in_words(scene) + "; " +
                                                report::material_in_words(scene) + ". Readings: ") +
                                     escaped(readings) + "."),
                   {}, made);
  return {.html = page_html(readings + " - tactile-net", html)};
}

drawing::Page recording_page(const lab::SkinRecordingAnswer& recording, const std::string& readings,
                             const Made& made) {
  const SkinScene& scene = recording.scene;
  const lab::SkinExperiment hardest{.scene = scene,
                                    .grid = recording.grid,
                                    .frame = {.readings = recording.readings},
                                    .answer = recording.answer};
  drawing::Page page;
  if (recording.answer) page.files = report::run_files(hardest);
  std::string html =
      heading(scene.title, scene.file + ", " + readings,
              std::to_string(recording.frames.size()) +
                  (recording.frames.size() == 1 ? " frame; " : " frames; ") +
                  report::sensor_in_words(scene) + "; " + report::material_in_words(scene));
  html += answer_box(report::answers(recording));
  html += suspicions(recording.findings, scene);
  html += remarks_html(report::remarks_in_words(hardest));
  if (!recording.shown.empty()) html += frames_section(recording);
  if (recording.answer && recording.frames.size() > 1)
    html += element("h2", "Frame " + std::to_string(recording.hardest) + ", which presses hardest");
  if (recording.answer) html += frame_html(hardest);
  html += colophon("The scene, the files, the command", scene_html(scene), page.files, made);
  page.html = page_html(scene.file + " - tactile-net", html);
  return page;
}

}  // namespace tactile_net::pages

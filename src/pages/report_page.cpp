#include "tactile_net/pages/report_page.hpp"

#include <string>
#include <variant>

#include "pages/parts.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::escaped;

std::string standing_mark(const std::string& word, lab::Standing standing) {
  const auto mark = [&](std::string_view type, std::string_view sign) {
    return mark_of(word, type, sign, report::standing_meaning(standing));
  };
  switch (standing) {
    case lab::Standing::no_answer:
      return mark("failed", "✗");
    case lab::Standing::needs_a_look:
      return mark("doubtful", "!");
    case lab::Standing::fine:
      break;
  }
  return mark("good", "✓");
}

std::string recordings_table(report::RecordingRows rows, const AnyScene& scene) {
  std::size_t next = 0;  // of the rows, whose cells come one after the other
  const auto cell = [&](std::size_t column, const std::string& text) {
    if (column == 1) return standing_mark(text, rows[next - 1].standing());
    if (column > 1) return drawing::words_html(text);
    const std::string& page = rows[next++].page;
    return page.empty() ? escaped(text)
                        : "<a href=\"" + escaped(page) + "\">" + escaped(text) + "</a>";
  };
  return "<div class=\"sortable\">" +
         drawing::html_table(report::recording_cells(rows, scene), cell) +
         drawing::data_html(report::recording_keys_json(rows, scene)) + "</div>\n";
}

}  // namespace

drawing::Page report_page(report::RecordingRows rows, const AnyScene& scene, const Made& made) {
  drawing::Page page{.files = {{"recordings.csv", report::recordings_csv(rows, scene)}}};
  std::visit(
      [&](const auto& one) {
        const std::string words =
            report::sensor_in_words(one) + "; " + report::material_in_words(one);
        std::string html =
            heading(one.title, one.file, counted(rows.size(), "recording") + "; " + words);
        html += answer_box(report::answers(rows));
        html += recordings_table(rows, scene);
        html += drawing::element("p", report::order_in_words(), "quiet");
        html += colophon("The files, the command", {}, page.files, made);
        page.html = page_html(one.file + " - tactile-net report", html);
      },
      scene);
  return page;
}

}  // namespace tactile_net::pages

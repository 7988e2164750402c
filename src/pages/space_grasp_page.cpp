#include "tactile_net/pages/space_grasp_page.hpp"

#include "pages/grasp_parts.hpp"
#include "pages/space_hand_drawing.hpp"
#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/report/words/space_grasp_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::html_list;

std::string section(const lab::SpaceGraspResult& grasp, const std::string& title,
                    const auto& answer, std::vector<std::string> words) {
  for (const std::string& line : report::internal_in_words(grasp, answer.internal))
    words.push_back(line);
  return grasp_tables(title, report::contact_cells(grasp, answer.grasp.fingers, answer.margins),
                      report::torque_cells(grasp, answer.grasp.fingers, answer.margins),
                      "Torques of the joints from the palm to the tip, right-handed about their "
                      "axes; of a joint that slides its force:") +
         html_list(words);
}

}  // namespace

std::string grasp_report_html(const lab::SpaceGraspResult& grasp, const Made& made) {
  const SpaceHand& hand = grasp.hand;
  std::string html = heading(hand.title, hand.file,
                             std::to_string(grasp.tips.size()) +
                                 (grasp.tips.size() == 1 ? " finger; " : " fingers; ") +
                                 report::load_in_words(grasp));
  html += answer_box(report::answers(grasp));
  html += paragraphs(report::failures_in_words(grasp), "bad");
  html += drawing::figure_html("hand", draw_hand(grasp),
                               arrows_caption({.measured = grasp.measured.has_value(),
                                               .held = grasp.held.has_value(),
                                               .load = hand.load.has_value(),
                                               .cones = has_friction(hand.fingers)}) +
                                   " All three views are to one scale.",
                               "result.json", "sheet");
  html += remarks_html(report::remarks_in_words(grasp));
  if (grasp.measured)
    html += section(grasp, "What the measured forces mean", *grasp.measured,
                    report::balance_in_words(grasp));
  if (grasp.held)
    html += section(grasp, "What would hold the load", *grasp.held, report::hold_in_words(grasp));
  html +=
      element("h2", "Where the contacts come from") + html_list(report::sources_in_words(grasp));
  html += pad_contacts_html(report::pad_contacts(grasp));
  html += element("p",
                  "± is one standard deviation. Normal is into the pad, y and z run along it; the "
                  "distance to the friction cone's edge is a force, with torsion over its radius "
                  "among the drags.");
  html += colophon("The hand, the files, the command",
                   drawing::enclosed("p", "Hand: " + drawing::escaped(hand.file) + "."), {}, made);
  return page_html(hand.file + " - tactile-net grasp", html);
}

}  // namespace tactile_net::pages

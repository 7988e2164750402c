#include "tactile_net/pages/grasp_page.hpp"

#include "pages/grasp_parts.hpp"
#include "pages/hand_drawing.hpp"
#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::figure_html;
using drawing::html_list;
using report::answers;
using report::balance_in_words;
using report::contact_cells;
using report::failures_in_words;
using report::hold_in_words;
using report::load_in_words;
using report::remarks_in_words;
using report::sources_in_words;
using report::torque_cells;

std::string caption(const lab::GraspResult& grasp) {
  return arrows_caption({.measured = grasp.measured.has_value(),
                         .held = grasp.held.has_value(),
                         .load = grasp.hand.load.has_value(),
                         .cones = has_friction(grasp.hand.fingers)}) +
         " Lengths are to scale in both directions" +
         (grasp.hand.fingers.size() > 1 ? "; dashes join the contacts." : ".");
}

std::string tables(const lab::GraspResult& grasp, const std::string& title,
                   const std::vector<FingerAction>& actions,
                   const std::vector<lab::FingerMargins>& margins) {
  return grasp_tables(title, contact_cells(grasp, actions, margins),
                      torque_cells(grasp, actions, margins),
                      "Torques, counter-clockwise, joints from the palm to the tip:");
}

}  // namespace

std::string grasp_report_html(const lab::GraspResult& grasp, const Made& made) {
  const Hand& hand = grasp.hand;
  std::string html =
      heading(hand.title, hand.file,
              std::to_string(grasp.tips.size()) +
                  (grasp.tips.size() == 1 ? " finger; " : " fingers; ") + load_in_words(grasp));
  html += answer_box(answers(grasp));
  html += paragraphs(failures_in_words(grasp), "bad");
  html += "<div class=\"two top\">" +
          figure_html("hand", draw_hand(grasp), caption(grasp), "result.json") + "<div>";
  if (grasp.measured)
    html += tables(grasp, "What the measured forces mean", grasp.measured->grasp.fingers,
                   grasp.measured->margins);
  if (grasp.held)
    html +=
        tables(grasp, "What would hold the load", grasp.held->grasp.fingers, grasp.held->margins);
  html += "</div></div>\n" + remarks_html(remarks_in_words(grasp));
  if (grasp.measured)
    html += element("h2", "How the measured forces balance") + html_list(balance_in_words(grasp));
  if (grasp.held) html += element("h2", "How it is held") + html_list(hold_in_words(grasp));
  html += element("h2", "Where the contacts come from") + html_list(sources_in_words(grasp));
  html += pad_contacts_html(report::pad_contacts(grasp));
  html += element("p",
                  "± is one standard deviation. Normal is into the pad and tangential along its y; "
                  "the distance to the friction cone's edge is a force.");
  html += colophon("The hand, the files, the command",
                   drawing::enclosed("p", "Hand: " + drawing::escaped(hand.file) + "."), {}, made);
  return page_html(hand.file + " - tactile-net grasp", html);
}

}  // namespace tactile_net::pages

#include "tactile_net/pages/grasp_page.hpp"

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/pages/hand_drawing.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::element;
using drawing::escaped;
using drawing::figure_html;
using drawing::html_list;
using drawing::html_page;
using drawing::html_table;
using report::balance_in_words;
using report::contact_cells;
using report::failures_in_words;
using report::hold_in_words;
using report::load_in_words;
using report::sources_in_words;
using report::torque_cells;
using report::warnings_in_words;

std::string key(const std::string& type, const std::string& words) {
  return "<span class=\"key-" + type + "\">" + escaped(words) + "</span>";
}

std::string caption(const lab::GraspResult& grasp) {
  std::string html = "Forces on the object: ";
  if (grasp.measured)
    html += key("measured", grasp.held ? "as measured (thin arrows, blue)" : "as measured (blue)");
  if (grasp.measured && grasp.held) html += ", ";
  if (grasp.held)
    html += key("held", grasp.measured ? "what would hold the load (thick, orange)"
                                       : "what would hold the load (orange)");
  if (grasp.hand.load) html += ", and " + key("load", "the load (green)");
  html += ".";
  bool any = false;
  for (const HandFinger& finger : grasp.hand.fingers) any = any || finger.friction.has_value();
  if (any)
    html +=
        " A force holds while its arrow stays inside its grey cone of friction, whose length "
        "means nothing.";
  if (grasp.measured && grasp.held)
    html +=
        " Where thin and thick arrows of a finger part, the fingers do not press as the load "
        "asks.";
  return html + " Lengths are to scale in both directions" +
         (grasp.hand.fingers.size() > 1 ? "; dashes join the contacts." : ".");
}

std::string answer(const lab::GraspResult& grasp, const std::string& title,
                   const std::vector<FingerAction>& actions,
                   const std::vector<lab::FingerMargins>& margins,
                   const std::vector<std::string>& words) {
  return element("h2", title) + html_list(words) +
         html_table(contact_cells(grasp, actions, margins)) +
         element("p", "Torques, counter-clockwise, joints from the palm to the tip:") +
         html_table(torque_cells(grasp, actions, margins));
}

}  // namespace

std::string grasp_report_html(const lab::GraspResult& grasp) {
  const Hand& hand = grasp.hand;
  std::string html = element("h1", hand.title.empty() ? hand.file : hand.title);
  if (!hand.title.empty()) html += element("p", hand.file);
  html += figure_html("hand", draw_hand(grasp), caption(grasp), "result.json");
  for (const std::string& failure : failures_in_words(grasp)) html += element("p", failure, "bad");
  for (const std::string& warning : warnings_in_words(grasp)) html += element("p", warning, "note");
  html += element("h2", "The grasp");
  html += element("p", std::to_string(grasp.tips.size()) +
                           (grasp.tips.size() == 1 ? " finger; " : " fingers; ") +
                           load_in_words(grasp) + ".");
  html += html_list(sources_in_words(grasp));
  if (grasp.measured)
    html += answer(grasp, "What the measured forces mean", grasp.measured->grasp.fingers,
                   grasp.measured->margins, balance_in_words(grasp));
  if (grasp.held)
    html += answer(grasp, "What would hold the load", grasp.held->grasp.fingers,
                   grasp.held->margins, hold_in_words(grasp));
  html +=
      element("p",
              "+- is one standard deviation. Normal is into the pad and tangential along its y; "
              "the distance to the friction cone's edge is a force.");
  return html_page(hand.file + " - tactile-net", html, drawing_style());
}

}  // namespace tactile_net::pages

#include "tactile_net/report/pages/grasp_page.hpp"

#include "tactile_net/report/pages/figure.hpp"
#include "tactile_net/report/pages/hand_drawing.hpp"
#include "tactile_net/report/pages/html.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::report {
namespace {

std::string key(const std::string& type, const std::string& words) {
  return "<span class=\"key-" + type + "\">" + escaped(words) + "</span>";
}

std::string caption(const lab::GraspStudy& study) {
  std::string html = "Forces on the object: ";
  if (study.measured)
    html += key("measured", study.held ? "as measured (thin arrows, blue)" : "as measured (blue)");
  if (study.measured && study.held) html += ", ";
  if (study.held)
    html += key("held", study.measured ? "what would hold the load (thick, orange)"
                                       : "what would hold the load (orange)");
  if (study.hand.load) html += ", and " + key("load", "the load (green)");
  html += ".";
  bool any = false;
  for (const HandFinger& finger : study.hand.fingers) any = any || finger.friction.has_value();
  if (any)
    html +=
        " A force holds while its arrow stays inside its grey cone of friction, whose length "
        "means nothing.";
  if (study.measured && study.held)
    html +=
        " Where thin and thick arrows of a finger part, the fingers do not press as the load "
        "asks.";
  return html + " Lengths are to scale in both directions" +
         (study.hand.fingers.size() > 1 ? "; dashes join the contacts." : ".");
}

std::string answer(const lab::GraspStudy& study, const std::string& title,
                   const std::vector<FingerAction>& actions,
                   const std::vector<lab::FingerMargins>& margins,
                   const std::vector<std::string>& words) {
  return element("h2", title) + html_list(words) +
         html_table(contact_cells(study, actions, margins)) +
         element("p", "Torques, counter-clockwise, joints from the palm to the tip:") +
         html_table(torque_cells(study, actions, margins));
}

}  // namespace

std::string grasp_report_html(const lab::GraspStudy& study) {
  const Hand& hand = study.hand;
  std::string html = element("h1", hand.title.empty() ? hand.file : hand.title);
  if (!hand.title.empty()) html += element("p", hand.file);
  html += figure_html("hand", draw_hand(study), caption(study), "result.json");
  for (const std::string& failure : study.failures) html += element("p", failure, "bad");
  for (const std::string& warning : study.warnings) html += element("p", warning, "note");
  html += element("h2", "The grasp");
  html += element("p", std::to_string(study.tips.size()) +
                           (study.tips.size() == 1 ? " finger; " : " fingers; ") +
                           load_in_words(study) + ".");
  html += html_list(sources_in_words(study));
  if (study.measured)
    html += answer(study, "What the measured forces mean", study.measured->fingers,
                   study.measured_margins, balance_in_words(study));
  if (study.held)
    html += answer(study, "What would hold the load", study.held->fingers, study.held_margins,
                   hold_in_words(study));
  html +=
      element("p",
              "+- is one standard deviation. Normal is into the pad and tangential along its y; "
              "the distance to the friction cone's edge is a force.");
  return html_page(hand.file + " - tactile-net", html, drawing_style());
}

}  // namespace tactile_net::report

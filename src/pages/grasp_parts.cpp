#include "pages/grasp_parts.hpp"

namespace tactile_net::pages {

using drawing::element;

std::string arrow_key(const std::string& type, const std::string& words) {
  return "<span class=\"key-" + type + "\">" + drawing::escaped(words) + "</span>";
}

std::string arrows_caption(const ArrowsShown& shown) {
  std::string html = "Forces on the object: ";
  if (shown.measured)
    html += arrow_key("measured",
                      shown.held ? "as measured (thin arrows, blue)" : "as measured (blue)");
  if (shown.measured && shown.held) html += ", ";
  if (shown.held)
    html += arrow_key("held", shown.measured ? "what would hold the load (thick, orange)"
                                             : "what would hold the load (orange)");
  if (shown.load) html += ", and " + arrow_key("load", "the load (green)");
  html += "; the pointer on an arrow tells its numbers.";
  if (shown.cones)
    html +=
        " A force holds while its arrow stays inside its grey cone of friction, whose length "
        "means nothing.";
  if (shown.measured && shown.held)
    html +=
        " Where thin and thick arrows of a finger part, the fingers do not press as the load "
        "asks.";
  return html;
}

std::string row_in_words(const std::vector<std::vector<std::string>>& table, std::size_t row) {
  std::string words = table[row][0];
  for (std::size_t k = 1; k < table[row].size(); ++k)
    words += (k == 1 ? ": " : ", ") + table[0][k] + ' ' + table[row][k];
  return words;
}

std::string grasp_tables(const std::string& title,
                         const std::vector<std::vector<std::string>>& contacts,
                         std::vector<std::vector<std::string>> torques,
                         const std::string& about_torques) {
  for (std::size_t i = 1; i < torques.size(); ++i)  // a card stands alone
    if (torques[i][0].empty()) torques[i][0] = torques[i - 1][0];
  std::string html =
      element("h2", title) + "<div class=\"cards\">" + verdict_table(contacts) + "</div>";
  if (torques.size() > 1)
    html += element("p", about_torques, "quiet") + drawing::html_table(torques);
  return html;
}

std::string pad_contacts_html(const std::vector<report::PadContacts>& pads) {
  std::string html;
  for (const report::PadContacts& pad : pads)
    html += element("p", pad.title) + drawing::html_table(pad.rows);
  return html;
}

}  // namespace tactile_net::pages

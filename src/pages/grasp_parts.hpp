/// @file
/// What the pages of a grasp of the plane and of one in space have in common. Private.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pages/parts.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::pages {

/// Words in the colour of the arrows that they are about.
[[nodiscard]] std::string arrow_key(const std::string& type, const std::string& words);

/// Which arrows are which, and what a cone is.
struct ArrowsShown {
  bool measured = false;
  bool held = false;
  bool load = false;
  bool cones = false;
};
[[nodiscard]] std::string arrows_caption(const ArrowsShown& shown);

/// A table of contacts as cards, and one of torques.
/// @param torques  with its head; a finger's name stands in its first row alone
[[nodiscard]] std::string grasp_tables(const std::string& title,
                                       const std::vector<std::vector<std::string>>& contacts,
                                       std::vector<std::vector<std::string>> torques,
                                       const std::string& about_torques);

/// A row of such a table in one line, for a pointer: "left: contact at (1, 2) mm, verdict holds".
[[nodiscard]] std::string row_in_words(const std::vector<std::vector<std::string>>& table,
                                       std::size_t row);
/// A table for each pad with several contacts.
[[nodiscard]] std::string pad_contacts_html(const std::vector<report::PadContacts>& pads);

/// Whether any finger has a friction.
[[nodiscard]] bool has_friction(const auto& fingers) {
  bool any = false;
  for (const auto& finger : fingers) any = any || finger.friction.has_value();
  return any;
}

}  // namespace tactile_net::pages

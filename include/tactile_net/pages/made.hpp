/// @file
/// What a page cannot know of itself.
#pragma once

#include <string>
#include <vector>

namespace tactile_net::pages {

struct Made {
  std::string by{};                  ///< the command line that made it, as one types it
  std::vector<std::string> files{};  ///< that whoever writes it puts beside it, besides its own
};

}  // namespace tactile_net::pages

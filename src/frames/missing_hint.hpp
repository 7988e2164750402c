/// @file
/// What to do about a value that is missing, the same for every kind of file. Private.
#pragma once

#include <string>

#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::frames {

[[nodiscard]] inline std::string missing_hint() {
  return option(Option::missing, "skip") + " leaves such frames out, " +
         option(Option::missing, "estimate") +
         " solves them without the taxels that miss; a taxel that never works belongs under "
         "[dead_taxels]";
}

}  // namespace tactile_net::frames

/// @file
/// Private. The circuit of a run, as a section of its page.
#pragma once

#include <string>

#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::pages {

/// What the simulator has made of it; its deck is the file network.cir beside the page.
[[nodiscard]] std::string network_section(const lab::Relaxation& relaxation);

}  // namespace tactile_net::pages

/// @file
/// What strangers' decks are kept from on this machine, in words.
#pragma once

#include <string>

#include "tactile_net/simulator/confinement.hpp"

namespace tactile_net::report {

/// A sentence or two, without a line end.
[[nodiscard]] std::string in_words(const Confinement& confinement);

}  // namespace tactile_net::report

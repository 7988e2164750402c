/// @file
/// The tables of a hand in space. Private.
#pragma once

#include "scene/references.hpp"
#include "scene/table.hpp"
#include "tactile_net/scene/space_hand.hpp"

namespace tactile_net {

/// The whole file; what is wrong is with the table's problems afterwards.
void read_space_hand(Table& root, const References& references, SpaceHand& hand);

}  // namespace tactile_net

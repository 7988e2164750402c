/// @file
/// A scene's circuit, varied.
#pragma once

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// Gives the op-amps that gain-bandwidth product [Hz], from 1e-3 to 1e15, and asks for the settling
/// time (to 1e-3, unless the scene says to what).
void give_bandwidth(NetworkOptions& network, double hertz);

}  // namespace tactile_net::lab

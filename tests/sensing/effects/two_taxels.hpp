/// @file
/// The array of effects that treat every taxel alike.
#pragma once

#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

inline const SensorArray two_taxels{2, 1.0, {1.0}, {Quantity::stress_x}};

}  // namespace tactile_net

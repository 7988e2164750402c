/// @file
/// A skin as the effects of the signal path see it.
///
///     stages.push_back(make_effect(NoiseModel{.rms = {{Quantity::stress_x, 2.0}}},
///                                  signal_layout(skin)));
#pragma once

#include "tactile_net/sensing/effects/signal_layout.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net {

/// The signal path's view of a skin. Neighbours are taxels one row or one column apart; in an
/// irregular skin taxels no further apart than 1.3 times the mean distance to the nearest one: four
/// on a square lattice, six on a hexagonal one.
///
/// @pre  a skin in its range
[[nodiscard]] SignalLayout signal_layout(const SkinArray& skin);

}  // namespace tactile_net

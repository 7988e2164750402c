/// @file
/// Signals that leak from a taxel to its neighbours.
#pragma once

#include <memory>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// Between neighbours i and j of one channel, `fraction` of the difference of their signals flows;
/// on a line
///
///     out(j) = in(j) + fraction (in(j-1) - in(j)) + fraction (in(j+1) - in(j))
///
/// A taxel at an end has one neighbour; a taxel inside a skin's lattice has four. The sum over the
/// array and a signal that is the same everywhere stay what they are.
struct Crosstalk {
  double fraction = 0.0;  ///< 0 ... 1 / (most neighbours of a taxel): on a line 0.5
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const Crosstalk& crosstalk,
                                                        const SignalLayout& sensor);

}  // namespace tactile_net

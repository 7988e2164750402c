/// @file
/// A circuit over time whose amplifiers cannot follow at any rate.
#pragma once

#include <optional>

#include "tactile_net/network/state_space.hpp"

namespace tactile_net {

/// What is left of the rate r [V/s] that an amplifier of that slew [V/s] is asked for:
/// slew tanh((1 - leak) r / slew) + leak r, with `slewing_leak`.
[[nodiscard]] double slewing_rate(double rate, double slew) noexcept;

/// The steepest that a slewing state is asked to rise while the circuit comes from rest to its end,
/// over its limit, to some per cent; 0: there is none. Of a circuit that settles.
[[nodiscard]] double slewing_demand(const StateSpace& system);

/// More states than this are not integrated: they would take minutes.
inline constexpr std::size_t most_slewing_states = 300;

/// As `settling_time`, of x' = A x + b with its slewing states' rates bent: by a method of
/// Rosenbrock's of second order until none of them slews any more, exactly from there on.
///
/// @throw std::invalid_argument  more than `most_slewing_states` states
[[nodiscard]] std::optional<double> slewing_settling_time(const StateSpace& system, double accuracy,
                                                          double slowest);

}  // namespace tactile_net

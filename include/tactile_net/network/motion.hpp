/// @file
/// How far a circuit's answer stays behind readings that move.
#pragma once

#include <span>

#include "tactile_net/network/network_circuit.hpp"

namespace tactile_net {

/// Readings that change steadily, g + g' s: the answer follows as it would at rest, `seconds` ago.
/// Exact for the linear circuit once it has settled; while the shape of the readings changes too,
/// an edge that passes a taxel lags up to three times as much.
struct MotionLag {
  double seconds = 0.0;   ///< |C A^-2 B g'| / |C A^-1 B g'|
  double relative = 0.0;  ///< |C A^-2 B g'| / |f|: of the answer, per unit of s a second
};

/// @param rate  g': of the problem's readings, weighted as they are, per unit of s
/// @throw std::invalid_argument  another number of readings, or as `state_space`
/// @throw std::domain_error      as `state_space`; the circuit is unstable, or rests at 0
[[nodiscard]] MotionLag motion_lag(const NetworkCircuit& circuit, std::span<const double> rate);

}  // namespace tactile_net

/// @file
/// How much more lag a circuit's amplifiers bear before it oscillates.
///
///     phase_margin(circuit)->degrees;
#pragma once

#include <optional>

#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {

struct PhaseMargin {
  double degrees = 0.0;  ///< 0 to 180; of a circuit that is unstable it means nothing
  double hertz = 0.0;    ///< where that lag makes it oscillate
};

/// The least angle, of either sign, by which turning every amplifier's input alike at one frequency
/// makes a pole there: of all characteristic loci of the loops (MacFarlane and Postlethwaite 1977)
/// the one that passes nearest to -1 on the unit circle. Of one amplifier it is the usual phase
/// margin. To a hundredth of a degree.
///
/// @return  absent: no locus reaches the unit circle, so that no lag makes it oscillate
/// @throw std::invalid_argument  an amplifier without bandwidth, none at all, or an inductor
/// @throw std::domain_error      nodes without capacitance have no unique voltage
[[nodiscard]] std::optional<PhaseMargin> phase_margin(const FlatCircuit& circuit);

}  // namespace tactile_net

/// @file
/// Volts and siemens that suit a circuit's op-amps. Private.
#pragma once

#include <optional>

#include "tactile_net/network/certificate.hpp"

namespace tactile_net {

/// From a certificate that has its noise, errors and dynamics. Nothing where neither noise nor
/// offsets nor bias currents disturb the answer, there is no answer, or converters or inverters
/// have resistors of their own, which no scale moves.
[[nodiscard]] std::optional<ScaleProposal> scale_proposal(const Certificate& certificate,
                                                          const NetworkCircuit& circuit);

}  // namespace tactile_net

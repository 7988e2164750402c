/// @file
/// Volts and siemens that suit a circuit's op-amps. Private.
#pragma once

#include <optional>

#include "tactile_net/network/certificate.hpp"

namespace tactile_net {

/// From a certificate that has its noise, errors and dynamics. Nothing where neither noise nor
/// offsets nor bias currents disturb the answer, the circuit is not known to be stable, there is no
/// answer, or converters or inverters have resistors of their own, which no scale moves. Siemens at
/// which it would not be known to be stable are not proposed: then they stay as they are.
[[nodiscard]] std::optional<ScaleProposal> scale_proposal(const Certificate& certificate,
                                                          const NetworkCircuit& circuit);

}  // namespace tactile_net

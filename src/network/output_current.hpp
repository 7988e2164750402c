/// @file
/// What op-amps' outputs carry at rest. Private.
#pragma once

#include "tactile_net/network/certificate.hpp"

namespace tactile_net {

/// The largest of all outputs, second ones included, from the linear equations at rest.
///
/// @pre  the circuit has an amplifier
/// @throw std::invalid_argument, std::domain_error  as `operating_voltages`
[[nodiscard]] OutputCurrent output_current(const FlatCircuit& circuit);

}  // namespace tactile_net

/// @file
/// How much lag the loop of `least_squares` bears: theorem T6 and T6L with input capacitance and
/// second poles, T6L with capacitance at the ladder's nodes alone (docs/circuits.md). Private.
#pragma once

#include "tactile_net/network/certificate.hpp"

namespace tactile_net {

/// @param circuit  `least_squares` with complementary outputs and a bandwidth
/// @throw std::domain_error  its equations have no answer
[[nodiscard]] LagBound lag_bound(const NetworkCircuit& circuit);

}  // namespace tactile_net

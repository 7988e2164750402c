/// @file
/// What ngspice says of a circuit at rest.
#pragma once

#include <vector>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net {

/// Voltages of the outputs.
inline std::vector<double> at_rest(const Circuit& circuit,
                                   const Analysis& analysis = DirectCurrent{}) {
  Ngspice ngspice;
  return operating_point(ngspice, circuit, "test", analysis).voltages;
}

}  // namespace tactile_net

/// @file
/// What ngspice says of a circuit at rest.
#pragma once

#include <sstream>
#include <vector>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/simulator/ngspice.hpp"

namespace tactile_net {

/// Voltages of the outputs.
inline std::vector<double> at_rest(const Circuit& circuit,
                                   const Analysis& analysis = DirectCurrent{}) {
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = "test"}, Answer::raw_file, analysis);
  Ngspice ngspice;
  return operating_point(ngspice, deck.str(), output_names(circuit)).voltages;
}

}  // namespace tactile_net

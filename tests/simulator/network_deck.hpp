/// @file
/// Decks of whole networks.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tests/network/networks.hpp"

namespace tactile_net {

struct Network {
  std::string deck;
  std::vector<std::string> nodes;
};

inline Network make_network(Realization realization, std::size_t n, unsigned seed,
                            Answer answer = Answer::raw_file) {
  const std::vector<double> b(n, 0.25);
  const Circuit circuit =
      realize(realization, {.matrix = random_definite(n, seed), .right_side = b}, {});
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = "network"}, answer);
  return {deck.str(), output_names(circuit)};
}

}  // namespace tactile_net

/// @file
/// A deck on disk: generated, perhaps edited by hand, and relaxed again.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::decks {

/// What one node was expected to have, and has.
struct NodeAnswer {
  std::string node{};
  double expected = 0.0;  ///< [V], of the header's `* expect` line
  double found = 0.0;     ///< [V]
};

struct DeckAnswer {
  std::vector<NodeAnswer> nodes{};
  double within = 1e-9;     ///< allowed difference: of the header's `* within` line
  double difference = 0.0;  ///< |found - expected|_2 / |expected|_2
  double ngspice_seconds = 0.0;
};

/// Whether a command's SCENE is a deck: its name ends with .cir, .sp, .spice or .net.
[[nodiscard]] bool is_deck(const std::string& path);

/// @throw InputError  the name is a deck's, where a scene is asked for
void refuse_deck(const std::string& path);

/// Runs the deck's own analysis, `.op` or one frequency of `.ac`, and reads the nodes that its
/// header expects. A deck is a program, and may be a stranger's: only cards that describe a circuit
/// and its analysis are taken (docs/strangers.md), and they alone reach the simulator; the
/// comments and the commands to ngspice behind `.end` do not.
///
/// @throw InputError      the file cannot be read or is larger than 64 MiB; another card, at its
///                        line; no `* expect NODE VOLTS` line, a malformed one, or more than 65536
/// @throw SimulatorError  as `operating_point`
[[nodiscard]] DeckAnswer relax_deck(const std::string& path, Simulator& simulator);

}  // namespace tactile_net::decks

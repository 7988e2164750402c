/// @file
/// A deck on disk: generated, perhaps edited by hand, and relaxed again.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::lab {

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
/// header expects. Commands to ngspice (`*#` lines, `.control` sections) are left out.
///
/// @throw InputError      the file cannot be read, has no `* expect NODE VOLTS` line or a malformed
///                        one
/// @throw SimulatorError  as `operating_point`
[[nodiscard]] DeckAnswer relax_deck(const std::string& path, Simulator& simulator);

}  // namespace tactile_net::lab

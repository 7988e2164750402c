/// @file
/// The command `relax`: a circuit in ngspice beside the direct solve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/network_options.hpp"
#include "streams.hpp"
#include "tactile_net/lab/simulator_choice.hpp"

namespace tactile_net::tool {

struct RelaxOptions {
  std::string scene{};  ///< or a deck
  std::string json{};
  std::optional<double> tolerance{};  ///< for a deck
  std::string model{};                ///< a vendor's macromodel for a scene's op-amps; empty: ours
  std::string board{};                ///< a file of KiCad, whose copper a scene's circuit has
  std::vector<std::string> refine{};  ///< keys over the scene's; empty: no refinement
  NetworkOptions network{};
  lab::SimulatorChoice simulator{};
};

/// @throw CheckFailed  the circuit differs by more than its parts explain
void run(const RelaxOptions& options, const Streams& streams);

}  // namespace tactile_net::tool

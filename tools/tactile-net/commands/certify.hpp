/// @file
/// The command `certify`: a circuit's stability and speed, without a simulator.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/network_options.hpp"
#include "commands/results.hpp"
#include "commands/share.hpp"
#include "streams.hpp"
#include "tactile_net/lab/board_certificate.hpp"

namespace tactile_net::tool {

struct CertifyOptions {
  std::string scene{};
  ResultOptions results{};
  NetworkOptions network{};
  std::optional<Share> budget{};
  std::string board{};  ///< a file of KiCad; empty: none
  double phase_margin = lab::usual_phase_margin;
  bool oscillating_board = false;
  bool datasheet = false;
  std::vector<std::string> refine{};  ///< keys over the scene's; empty: as it says
};

/// @throw CheckFailed  the circuit is not stable, or its datasheet misses a limit
void run(const CertifyOptions& options, const Streams& streams);

}  // namespace tactile_net::tool

/// @file
/// The command `certify`: a circuit's stability and speed, without a simulator.
#pragma once

#include <optional>
#include <string>

#include "commands/network_options.hpp"
#include "commands/results.hpp"
#include "commands/share.hpp"
#include "streams.hpp"

namespace tactile_net::tool {

struct CertifyOptions {
  std::string scene{};
  ResultOptions results{};
  NetworkOptions network{};
  std::optional<Share> budget{};
};

/// @throw CheckFailed  the circuit is not stable
void run(const CertifyOptions& options, const Streams& streams);

}  // namespace tactile_net::tool

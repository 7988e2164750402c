/// @file
/// The command `gen`: a scene's circuit as a SPICE deck.
#pragma once

#include <string>

#include "commands/network_options.hpp"
#include "streams.hpp"

namespace tactile_net::tool {

struct GenOptions {
  std::string scene{};
  std::string output{};
  NetworkOptions network{};
};

void run(const GenOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
